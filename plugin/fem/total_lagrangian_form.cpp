#include "synovia/fem/total_lagrangian_form.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/text.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace synovia
{

using namespace mfem;

namespace
{
// d(J F^-T)_ij / dF_kl, at [3 i + j][3 k + l].
Tangent3 CofactorDerivative(const Tensor3<> &F)
{
   constexpr int sign[3][3] = {{0, 1, -1}, {-1, 0, 1}, {1, -1, 0}};
   Tangent3 derivative{};
   for (int i = 0; i < 3; i++)
   {
      for (int k = 0; k < 3; k++)
      {
         for (int j = 0; j < 3 && k != i; j++)
         {
            for (int l = 0; l < 3; l++)
            {
               if (l != j)
               {
                  derivative[3 * i + j][3 * k + l] =
                     sign[i][k] * sign[j][l] * F[3 - i - k][3 - j - l];
               }
            }
         }
      }
   }
   return derivative;
}

// int (tangent : grad u_j) : grad w_i of a point, component by component.
void AddStiffness(const DenseMatrix &gradients, const Tangent3 &tangent,
                  real_t weight, DenseMatrix &matrix)
{
   const int dofs = gradients.Height();
   for (int b = 0; b < 3; b++)
   {
      for (int j = 0; j < dofs; j++)
      {
         real_t stress[9];
         for (int k = 0; k < 9; k++)
         {
            stress[k] = weight * (tangent[k][3 * b] * gradients(j, 0) +
                                  tangent[k][3 * b + 1] * gradients(j, 1) +
                                  tangent[k][3 * b + 2] * gradients(j, 2));
         }
         for (int a = 0; a < 3; a++)
         {
            real_t *const force = matrix.GetColumn(j + b * dofs) + a * dofs;
            for (int i = 0; i < dofs; i++)
            {
               force[i] += gradients(i, 0) * stress[3 * a] +
                           gradients(i, 1) * stress[3 * a + 1] +
                           gradients(i, 2) * stress[3 * a + 2];
            }
         }
      }
   }
}

// Adds weight q_k (A : grad u_j) for each component of u_j.
void AddProduct(const Vector &q, const Tensor3<> &A,
                const DenseMatrix &gradients, real_t weight,
                DenseMatrix &matrix)
{
   const int dofs = gradients.Height();
   for (int b = 0; b < 3; b++)
   {
      for (int j = 0; j < dofs; j++)
      {
         const real_t product =
            weight * (A[b][0] * gradients(j, 0) + A[b][1] * gradients(j, 1) +
                      A[b][2] * gradients(j, 2));
         real_t *const column = matrix.GetColumn(j + b * dofs);
         for (int k = 0; k < q.Size(); k++)
         {
            column[k] += product * q[k];
         }
      }
   }
}

// The change of the flow K grad p with F, as one tensor for each component.
std::array<Tensor3<>, 3> FlowChange(const Tangent3 &tangent,
                                    const Vector3<> &grad_p)
{
   std::array<Tensor3<>, 3> change;
   for (int a = 0; a < 3; a++)
   {
      for (int k = 0; k < 9; k++)
      {
         change[a][k / 3][k % 3] = tangent[3 * a][k] * grad_p[0] +
                                   tangent[3 * a + 1][k] * grad_p[1] +
                                   tangent[3 * a + 2][k] * grad_p[2];
      }
   }
   return change;
}

Vector3<> Apply(const Tensor3<> &A, const Vector3<> &x)
{
   Vector3<> y;
   for (int i = 0; i < 3; i++)
   {
      y[i] = A[i][0] * x[0] + A[i][1] * x[1] + A[i][2] * x[2];
   }
   return y;
}

void SumIntoTrueDofs(const ParFiniteElementSpace &space, const Vector &local,
                     Vector &true_dofs)
{
   true_dofs.SetSize(space.GetTrueVSize());
   space.GetProlongationMatrix()->MultTranspose(local, true_dofs);
}

void VerifyLaws(const NamedMesh &mesh, const MaterialTable &materials)
{
   for (const int attribute : mesh.Get().attributes)
   {
      if (!materials.Get(attribute).solid->IsObjective())
      {
         throw Error("the solid of \"" + NameOf(mesh.Regions(), attribute) +
                     "\" is a law of infinitesimal deformation; finite "
                     "deformation needs one that turns with the body");
      }
   }
}
} // namespace

TotalLagrangianForm::TotalLagrangianForm(
   const NamedMesh &mesh_, BiphasicSpaces &spaces_,
   const MaterialTable &materials_,
   const std::vector<SpringFoundation> &springs_)
   : mesh(mesh_), spaces(spaces_), materials(materials_), springs(springs_),
     matrices((VerifyLaws(mesh, materials), spaces), materials),
     stiffness(spaces.Displacement(), spaces.Displacement()),
     coupling(spaces.Pressure(), spaces.Displacement()),
     flow_change(spaces.Pressure(), spaces.Displacement()),
     darcy(spaces.Pressure(), spaces.Pressure()), element(spaces),
     u(spaces.Displacement().GetVSize()), p(spaces.Pressure().GetVSize())
{
   points = element.AllPoints();
   if (matrices.stabilization)
   {
      smooth_stabilization =
         std::make_unique<SmoothStabilization>(spaces, materials);
   }
   for (const SpringFoundation &spring : springs)
   {
      matrices.stiffness.reset(
         Add(1.0, *matrices.stiffness, 1.0, spring.Matrix()));
   }
}

void TotalLagrangianForm::ToLocal(const Vector &true_u,
                                  const Vector &true_p) const
{
   spaces.Displacement().GetProlongationMatrix()->Mult(true_u, u);
   spaces.Pressure().GetProlongationMatrix()->Mult(true_p, p);
   u.HostRead();
   p.HostRead();
}

void TotalLagrangianForm::GetConserved(const Vector &true_u,
                                       Vector &conserved) const
{
   Vector no_pressure(spaces.Pressure().GetTrueVSize());
   no_pressure = 0.0;
   ToLocal(true_u, no_pressure);
   conserved.SetSize(points);
   int at = 0;
   for (int e = 0; e < spaces.GetMesh().GetNE(); e++)
   {
      element.Set(e, u, p);
      for (int q = 0; q < element.Points(); q++)
      {
         element.SetPoint(q);
         const Tensor3<> &F = element.DeformationGradient();
         conserved[at++] = Determinant(F, Cofactor(F));
      }
   }
}

void TotalLagrangianForm::StartStage(const BodyStage &stage,
                                     const Vector &pressure_rate,
                                     real_t rate_dt)
{
   if (smooth_stabilization)
   {
      smooth_stabilization->Mult(pressure_rate, relief);
      relief *= std::min(stage.dt, rate_dt);
   }
}

void TotalLagrangianForm::Mult(const BodyStage &stage, Vector &momentum,
                               Vector &mass) const
{
   ToLocal(stage.u, stage.p);
   Vector local_momentum(u.Size());
   Vector local_mass(p.Size());
   local_momentum = 0.0;
   local_mass = 0.0;
   Vector forces;
   Vector volumes;
   Tensor3<> stress;
   Tensor3<> permeability;
   int at = 0;
   for (int e = 0; e < spaces.GetMesh().GetNE(); e++)
   {
      element.Set(e, u, p);
      const int u_nodes = element.DisplacementDofs().Size() / 3;
      forces.SetSize(3 * u_nodes);
      volumes.SetSize(element.PressureDofs().Size());
      forces = 0.0;
      volumes = 0.0;
      const Material &material = materials.Get(element.Attribute());
      for (int q = 0; q < element.Points(); q++)
      {
         element.SetPoint(q);
         const Tensor3<> &F = element.DeformationGradient();
         const Tensor3<> cofactor = Cofactor(F);
         const real_t J = Determinant(F, cofactor);
         const bool possible =
            J > 0.0 &&
            material.solid->GetStress(element.Point(), F, stress, nullptr) &&
            material.permeability->GetReferential(element.Point(), F,
                                                  permeability, nullptr);
         const real_t weight = possible
                                  ? element.Weight()
                                  : std::numeric_limits<real_t>::quiet_NaN();
         const DenseMatrix &gradients = element.Gradients();
         for (int a = 0; a < 3; a++)
         {
            real_t *const force = forces.GetData() + a * u_nodes;
            for (int b = 0; b < 3; b++)
            {
               const real_t total =
                  weight * (stress[a][b] - element.Pressure() * cofactor[a][b]);
               for (int i = 0; i < u_nodes; i++)
               {
                  force[i] += total * gradients(i, b);
               }
            }
         }
         const Vector3<> flow = Apply(permeability, element.PressureGradient());
         const real_t growth = weight * (J - stage.conserved0[at]);
         at++;
         for (int k = 0; k < volumes.Size(); k++)
         {
            const DenseMatrix &slope = element.PressureGradients();
            volumes[k] += growth * element.PressureShape()[k] +
                          weight * stage.dt *
                             (slope(k, 0) * flow[0] + slope(k, 1) * flow[1] +
                              slope(k, 2) * flow[2]);
         }
      }
      local_momentum.AddElementVector(element.DisplacementDofs(), forces);
      local_mass.AddElementVector(element.PressureDofs(), volumes);
   }
   SumIntoTrueDofs(spaces.Displacement(), local_momentum, momentum);
   SumIntoTrueDofs(spaces.Pressure(), local_mass, mass);
   for (const SpringFoundation &spring : springs)
   {
      spring.Matrix().Mult(1.0, stage.u, 1.0, momentum);
   }
   AddStabilization(stage, mass);
}

void TotalLagrangianForm::AddStabilization(const BodyStage &stage,
                                           Vector &mass) const
{
   if (matrices.stabilization)
   {
      Vector increment(stage.p);
      increment -= stage.p0;
      matrices.stabilization->Mult(1.0, increment, 1.0, mass);
      mass -= relief;
   }
}

void TotalLagrangianForm::MultFromStart(const BodyStage &stage,
                                        Vector &momentum, Vector &mass) const
{
   BodyStage start(stage);
   start.u = stage.u0;
   start.p = stage.p0;
   Mult(start, momentum, mass);
   Vector increment(stage.u);
   increment -= stage.u0;
   matrices.stiffness->Mult(1.0, increment, 1.0, momentum);
   matrices.divergence->Mult(1.0, increment, 1.0, mass);
   increment = stage.p;
   increment -= stage.p0;
   matrices.divergence_transpose->Mult(-1.0, increment, 1.0, momentum);
   matrices.darcy->Mult(stage.dt, increment, 1.0, mass);
   if (matrices.stabilization)
   {
      matrices.stabilization->Mult(1.0, increment, 1.0, mass);
   }
}

void TotalLagrangianForm::GetGrowth(const BodyStage &stage,
                                    Vector &growth) const
{
   ToLocal(stage.u, stage.p);
   Vector local(p.Size());
   local = 0.0;
   Vector volumes;
   int at = 0;
   for (int e = 0; e < spaces.GetMesh().GetNE(); e++)
   {
      element.Set(e, u, p);
      volumes.SetSize(element.PressureDofs().Size());
      volumes = 0.0;
      for (int q = 0; q < element.Points(); q++)
      {
         element.SetPoint(q);
         const Tensor3<> &F = element.DeformationGradient();
         volumes.Add(element.Weight() *
                        (Determinant(F, Cofactor(F)) - stage.conserved0[at]),
                     element.PressureShape());
         at++;
      }
      local.AddElementVector(element.PressureDofs(), volumes);
   }
   SumIntoTrueDofs(spaces.Pressure(), local, growth);
}

void TotalLagrangianForm::AddMagnitudes(real_t dt, const Vector &u_magnitude,
                                        const Vector &p_magnitude,
                                        Vector &momentum, Vector &mass) const
{
   matrices.stiffness->AbsMult(1.0, u_magnitude, 1.0, momentum);
   matrices.divergence->AbsMult(1.0, u_magnitude, 1.0, mass);
   matrices.darcy->AbsMult(dt, p_magnitude, 1.0, mass);
}

std::string TotalLagrangianForm::Validate(const BodyStage &stage) const
{
   ToLocal(stage.u, stage.p);
   std::string failure;
   for (int e = 0; e < spaces.GetMesh().GetNE() && failure.empty(); e++)
   {
      element.Set(e, u, p);
      for (int q = 0; q < element.Points() && failure.empty(); q++)
      {
         element.SetPoint(q);
         failure = ValidatePoint();
      }
   }
   return AgreeOnText(spaces.GetComm(), failure);
}

std::string TotalLagrangianForm::ValidatePoint() const
{
   const Material &material = materials.Get(element.Attribute());
   const Tensor3<> &F = element.DeformationGradient();
   const real_t J = Determinant(F, Cofactor(F));
   Tensor3<> value;
   std::string what;
   if (!(J > 0.0))
   {
      what = "is turned inside out";
   }
   else if (!(J > material.solid_fraction))
   {
      what = "has no pores left, as its solid fraction is " +
             ToText(material.solid_fraction);
   }
   else if (!material.solid->GetStress(element.Point(), F, value, nullptr))
   {
      what = "has no finite stress";
   }
   else if (!material.permeability->GetReferential(element.Point(), F, value,
                                                   nullptr))
   {
      what = "has no permeability";
   }
   if (what.empty())
   {
      return "";
   }
   const Vector x = element.Position();
   return "the body " + what + " at (" + ToText(x[0]) + ", " + ToText(x[1]) +
          ", " + ToText(x[2]) + ") in \"" +
          NameOf(mesh.Regions(), element.Attribute()) +
          "\": det F = " + ToText(J);
}

bool TotalLagrangianForm::Linearize(const BodyStage &stage)
{
   ToLocal(stage.u, stage.p);
   stiffness.SetZero();
   coupling.SetZero();
   flow_change.SetZero();
   darcy.SetZero();
   DenseMatrix u_matrix;
   DenseMatrix coupling_matrix;
   DenseMatrix change_matrix;
   DenseMatrix p_matrix;
   Tensor3<> value;
   Tangent3 tangent;
   Vector slope;
   for (int e = 0; e < spaces.GetMesh().GetNE(); e++)
   {
      element.Set(e, u, p);
      const Array<int> &u_dofs = element.DisplacementDofs();
      const Array<int> &p_dofs = element.PressureDofs();
      u_matrix.SetSize(u_dofs.Size());
      coupling_matrix.SetSize(p_dofs.Size(), u_dofs.Size());
      change_matrix.SetSize(p_dofs.Size(), u_dofs.Size());
      p_matrix.SetSize(p_dofs.Size());
      u_matrix = 0.0;
      coupling_matrix = 0.0;
      change_matrix = 0.0;
      p_matrix = 0.0;
      const Material &material = materials.Get(element.Attribute());
      for (int q = 0; q < element.Points(); q++)
      {
         element.SetPoint(q);
         const real_t weight = element.Weight();
         const Tensor3<> &F = element.DeformationGradient();
         const DenseMatrix &gradients = element.Gradients();
         material.solid->GetStress(element.Point(), F, value, &tangent);
         tangent -= element.Pressure() * CofactorDerivative(F);
         AddStiffness(gradients, tangent, weight, u_matrix);
         AddProduct(element.PressureShape(), Cofactor(F), gradients, weight,
                    coupling_matrix);
         material.permeability->GetReferential(element.Point(), F, value,
                                               &tangent);
         const std::array<Tensor3<>, 3> change =
            FlowChange(tangent, element.PressureGradient());
         const DenseMatrix &p_gradients = element.PressureGradients();
         for (int a = 0; a < 3; a++)
         {
            slope.SetSize(p_dofs.Size());
            for (int k = 0; k < p_dofs.Size(); k++)
            {
               slope[k] = p_gradients(k, a);
            }
            AddProduct(slope, change[a], gradients, weight * stage.dt,
                       change_matrix);
         }
         for (int k = 0; k < p_dofs.Size(); k++)
         {
            const Vector3<> flow =
               Apply(value,
                     {p_gradients(k, 0), p_gradients(k, 1), p_gradients(k, 2)});
            for (int l = 0; l < p_dofs.Size(); l++)
            {
               p_matrix(l, k) += weight * (p_gradients(l, 0) * flow[0] +
                                           p_gradients(l, 1) * flow[1] +
                                           p_gradients(l, 2) * flow[2]);
            }
         }
      }
      stiffness.Add(u_dofs, u_dofs, u_matrix);
      coupling.Add(p_dofs, u_dofs, coupling_matrix);
      flow_change.Add(p_dofs, u_dofs, change_matrix);
      darcy.Add(p_dofs, p_dofs, p_matrix);
   }
   matrices.stiffness = stiffness.Sum();
   for (const SpringFoundation &spring : springs)
   {
      matrices.stiffness.reset(
         mfem::Add(1.0, *matrices.stiffness, 1.0, spring.Matrix()));
   }
   const std::unique_ptr<HypreParMatrix> volume_change = coupling.Sum();
   matrices.divergence_transpose.reset(volume_change->Transpose());
   matrices.divergence.reset(
      mfem::Add(1.0, *volume_change, 1.0, *flow_change.Sum()));
   matrices.darcy = darcy.Sum();
   return true;
}

} // namespace synovia
