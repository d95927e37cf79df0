#include "synovia/fem/total_lagrangian_form.hpp"
#include "synovia/general/error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace synovia
{

using namespace mfem;

namespace
{
void SumIntoTrueDofs(const ParFiniteElementSpace &space, const Vector &local,
                     Vector &true_dofs)
{
   true_dofs.SetSize(space.GetTrueVSize());
   space.GetProlongationMatrix()->MultTranspose(local, true_dofs);
}

AssembledMatrix MakeMatrix(ParFiniteElementSpace &rows,
                           ParFiniteElementSpace &columns,
                           SpacePatterns &patterns)
{
   return AssembledMatrix(rows, columns, patterns.Between(rows, columns));
}

void VerifyLaws(const NamedMesh &mesh, const MaterialTable &materials)
{
   for (const int attribute : mesh.Get().attributes)
   {
      const Material &material = materials.Get(attribute);
      if (!material.IsRigid() && !material.solid->IsObjective())
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
   const std::vector<SpringFoundation> &springs_, const FollowerLoads &loads_,
   ElementPoints tangent_points, const GravityLoads *gravity_)
   : mesh(mesh_), spaces(spaces_), materials(materials_), springs(springs_),
     loads(loads_), gravity(gravity_),
     patterns((VerifyLaws(mesh, materials), spaces)),
     matrices(spaces, materials, patterns), balance(spaces.GetComm()),
     start_balance(spaces.GetComm()),
     stiffness(
        MakeMatrix(spaces.Displacement(), spaces.Displacement(), patterns)),
     growth_transpose(
        MakeMatrix(spaces.Displacement(), spaces.Pressure(), patterns)),
     divergence(MakeMatrix(spaces.Pressure(), spaces.Displacement(), patterns)),
     darcy(MakeMatrix(spaces.Pressure(), spaces.Pressure(), patterns)),
     element(spaces), damping(spaces, materials, element), tangent(spaces),
     permeability(spaces), u(spaces.Displacement().GetVSize()), u0(u.Size()),
     p(spaces.Pressure().GetVSize())
{
   matrices.symmetric = false;
   if (matrices.stabilization)
   {
      smooth_stabilization =
         std::make_unique<SmoothStabilization>(spaces, materials);
   }
   if (spaces.Order() == 1)
   {
      barrier = std::make_unique<CornerBarrier>(spaces, materials);
   }
   auto other = std::make_unique<BodyElement>(spaces, tangent_points);
   if (other->AllPoints() < element.AllPoints())
   {
      straight_element = std::move(other);
      CorrectStraightTangent();
   }
   AddSprings();
   MeasureRest();
}

void TotalLagrangianForm::MeasureRest()
{
   u = 0.0;
   p = 0.0;
   Vector momentum(u.Size());
   Vector mass(p.Size());
   momentum = 0.0;
   mass = 0.0;
   Vector forces;
   Vector volumes;
   for (int e = 0; e < spaces.GetMesh().GetNE(); e++)
   {
      if (IsRigid(e))
      {
         continue;
      }
      element.Set(e, u, p);
      const Material &material = materials.Get(element.Attribute());
      const bool wet = material.HasFluid();
      const real_t modulus = material.solid->AggregateModulus();
      const DenseMatrix &gradients = element.Gradients();
      const DenseMatrix &shapes = element.PressureShapes();
      const int nodes = gradients.Height();
      forces.SetSize(3 * nodes);
      volumes.SetSize(shapes.Height());
      forces = 0.0;
      volumes = 0.0;
      for (int q = 0; q < element.Points(); q++)
      {
         const real_t weight = std::abs(element.Weight(q));
         for (int k = 0; k < 3 * nodes; k++)
         {
            forces[k] += weight * modulus *
                         std::abs(gradients(k % nodes, 3 * q + k / nodes));
         }
         for (int k = 0; wet && k < volumes.Size(); k++)
         {
            volumes[k] += weight * std::abs(shapes(k, q));
         }
      }
      momentum.AddElementVector(element.DisplacementDofs(), forces);
      mass.AddElementVector(element.PressureDofs(), volumes);
   }
   SumIntoTrueDofs(spaces.Displacement(), momentum, rest_momentum);
   SumIntoTrueDofs(spaces.Pressure(), mass, rest_mass);
}

void TotalLagrangianForm::AddSprings()
{
   for (const SpringFoundation &spring : springs)
   {
      matrices.stiffness.reset(
         Add(1.0, *matrices.stiffness, 1.0, spring.Matrix()));
   }
}

void TotalLagrangianForm::ToLocal(const BodyStage &stage) const
{
   spaces.Displacement().GetProlongationMatrix()->Mult(stage.u, u);
   spaces.Pressure().GetProlongationMatrix()->Mult(stage.p, p);
   u.HostRead();
   p.HostRead();
}

Vector TotalLagrangianForm::ToLocal(const Vector &displacement) const
{
   Vector local_displacement(u.Size());
   spaces.Displacement().GetProlongationMatrix()->Mult(displacement,
                                                       local_displacement);
   local_displacement.HostRead();
   return local_displacement;
}

FollowerLoads::State TotalLagrangianForm::ToLoads(const BodyStage &stage) const
{
   spaces.Displacement().GetProlongationMatrix()->Mult(stage.u0, u0);
   u0.HostRead();
   return {stage.time, stage.dt, u, u0, p};
}

void TotalLagrangianForm::GetConserved(const Vector &true_u,
                                       Vector &conserved) const
{
   if (balance.HasDisplacement(true_u))
   {
      conserved = balance.volume_ratios;
      return;
   }
   BodyStage stage;
   stage.u = true_u;
   stage.p.SetSize(spaces.Pressure().GetTrueVSize());
   stage.p = 0.0;
   ToLocal(stage);
   conserved.SetSize(ConservedSize());
   for (int e = 0; e < spaces.GetMesh().GetNE(); e++)
   {
      element.Set(e, u, p);
      for (int q = 0; q < element.Points(); q++)
      {
         conserved[element.FirstPoint() + q] =
            det(element.DeformationGradient(q));
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
   CarryOver(stage);
   balance.Forget();
   damping.Clear();
}

void TotalLagrangianForm::CarryOver(const BodyStage &stage)
{
   start_balance.Forget();
   // Loads may be others then.
   if (HasLoads() || !balance.IsAtStartOf(stage))
   {
      return;
   }
   BodyStage start(stage);
   start.u = stage.u0;
   start.p = stage.p0;
   start_balance.Set(start);
   start_balance.momentum = balance.momentum;
   start_balance.growth.SetSize(balance.growth.Size());
   start_balance.growth = 0.0;
   start_balance.flow = balance.flow;
   start_balance.flow *= stage.dt / balance.StageLength();
   start_balance.mass = start_balance.flow;
   start_balance.volume_ratios = balance.volume_ratios;
   AddStabilization(start, start_balance.mass);
}

void TotalLagrangianForm::Mult(const BodyStage &stage, Vector &momentum,
                               Vector &mass) const
{
   Remember(stage, balance);
   momentum = balance.momentum;
   mass = balance.mass;
}

void TotalLagrangianForm::Remember(const BodyStage &stage,
                                   EvaluatedBalance &evaluated) const
{
   if (!evaluated.IsAt(stage))
   {
      evaluated.Set(stage);
      Evaluate(stage, evaluated);
   }
}

void TotalLagrangianForm::Evaluate(const BodyStage &stage,
                                   EvaluatedBalance &evaluated) const
{
   ToLocal(stage);
   local.momentum.SetSize(u.Size());
   local.growth.SetSize(p.Size());
   local.flow.SetSize(p.Size());
   local.momentum = 0.0;
   local.growth = 0.0;
   local.flow = 0.0;
   evaluated.volume_ratios.SetSize(element.AllPoints());
   evaluated.volume_ratios = 1.0;
   if (HasLoads())
   {
      AddLocalLoads(stage, local.momentum, local.flow);
      local.momentum *= -1.0;
      local.flow *= -stage.dt;
   }
   for (int e = 0; e < spaces.GetMesh().GetNE(); e++)
   {
      if (!IsRigid(e))
      {
         element.Set(e, u, p);
         AddElement(stage, evaluated.volume_ratios);
         if (barrier)
         {
            barrier->Set(e, u, p);
            barrier->AddForces(local.momentum);
         }
      }
   }
   SumIntoTrueDofs(spaces.Displacement(), local.momentum, evaluated.momentum);
   SumIntoTrueDofs(spaces.Pressure(), local.growth, evaluated.growth);
   SumIntoTrueDofs(spaces.Pressure(), local.flow, evaluated.flow);
   for (const SpringFoundation &spring : springs)
   {
      spring.Matrix().Mult(1.0, stage.u, 1.0, evaluated.momentum);
   }
   evaluated.mass = evaluated.growth;
   evaluated.mass += evaluated.flow;
   AddStabilization(stage, evaluated.mass);
}

void TotalLagrangianForm::AddDampingForces(const Vector &displacement,
                                           Vector &forces) const
{
   Vector local_forces(u.Size());
   local_forces = 0.0;
   damping.AddForces(ToLocal(displacement), local_forces);
   Vector sums;
   SumIntoTrueDofs(spaces.Displacement(), local_forces, sums);
   forces += sums;
}

void TotalLagrangianForm::AddLocalLoads(const BodyStage &stage, Vector &forces,
                                        Vector &inflow) const
{
   const FollowerLoads::State state = ToLoads(stage);
   loads.AddLoads(state, forces, inflow);
   if (gravity)
   {
      gravity->AddLoads(state, forces, inflow);
   }
}

void TotalLagrangianForm::AddLoads(const BodyStage &stage,
                                   Vector &momentum) const
{
   if (!HasLoads())
   {
      return;
   }
   ToLocal(stage);
   Vector local_forces(u.Size());
   Vector local_inflow(p.Size());
   local_forces = 0.0;
   local_inflow = 0.0;
   AddLocalLoads(stage, local_forces, local_inflow);
   Vector forces;
   SumIntoTrueDofs(spaces.Displacement(), local_forces, forces);
   momentum += forces;
}

void TotalLagrangianForm::AddElement(const BodyStage &stage,
                                     Vector &volume_ratios) const
{
   const Material &material = materials.Get(element.Attribute());
   const bool wet = material.HasFluid();
   const int points = element.Points();
   const bool mean_possible =
      !material.mean_dilatation ||
      mean_dilatation.Evaluate(element, *material.solid);
   if (wet)
   {
      permeability.Set(element);
   }
   DenseMatrix stresses(3 * points, 3);
   Vector growths(points);
   Vector supplies(points);
   Vector flows(3 * points);
   Tensor3<> stress;
   Tensor3<> conductance{};
   for (int q = 0; q < points; q++)
   {
      const Tensor3<> F = element.DeformationGradient(q);
      const Tensor3<> cofactor = Cofactor(F);
      const real_t J = Determinant(F, cofactor);
      const bool possible =
         mean_possible && J > 0.0 && GetStress(material, q, F, stress) &&
         (!wet ||
          (permeability.VolumeRatio(q) > material.solid_fraction &&
           permeability.Get(element, *material.permeability, q, conductance)));
      const real_t weight = possible ? element.Weight(q)
                                     : std::numeric_limits<real_t>::quiet_NaN();
      const Vector3<> flow = Product(conductance, element.PressureGradient(q));
      const real_t pressure = wet ? element.Pressure(q) : 0.0;
      for (int a = 0; a < 3; a++)
      {
         const Vector3<> row = element.ToReference(
            q, weight * (stress[a] - pressure * cofactor[a]));
         for (int c = 0; c < 3; c++)
         {
            stresses(3 * q + c, a) = row[c];
         }
      }
      const Vector3<> fluid =
         element.ToReference(q, (weight * stage.dt) * flow);
      for (int c = 0; c < 3; c++)
      {
         flows[3 * q + c] = fluid[c];
      }
      const int number = element.FirstPoint() + q;
      volume_ratios[number] = J;
      growths[q] = weight * (J - stage.conserved0[number]);
      supplies[q] = -weight * stage.dt * J * material.supply.Rate(pressure);
   }
   Vector forces(element.DisplacementDofs().Size());
   DenseMatrix by_node(forces.GetData(), forces.Size() / 3, 3);
   mfem::Mult(element.Slopes(), stresses, by_node);
   local.momentum.AddElementVector(element.DisplacementDofs(), forces);
   if (wet)
   {
      Vector volumes(element.PressureDofs().Size());
      element.PressureShapes().Mult(growths, volumes);
      local.growth.AddElementVector(element.PressureDofs(), volumes);
      element.PressureSlopes().Mult(flows, volumes);
      if (material.HasSupply())
      {
         element.PressureShapes().AddMult(supplies, volumes);
      }
      local.flow.AddElementVector(element.PressureDofs(), volumes);
   }
}

bool TotalLagrangianForm::GetStress(const Material &material, int point,
                                    const Tensor3<> &F, Tensor3<> &stress) const
{
   if (material.mean_dilatation)
   {
      stress = mean_dilatation.Stress(point);
      return true;
   }
   return material.solid->GetStress(element.Point(point), F, stress, nullptr);
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
   // The state that the stage is expected to end in is asked for again.
   Remember(start, start_balance);
   momentum = start_balance.momentum;
   mass = start_balance.mass;
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
                                    Vector &true_growth) const
{
   Remember(stage, balance);
   true_growth = balance.growth;
}

real_t TotalLagrangianForm::Inflow(const BodyStage &stage) const
{
   if (!loads.Any())
   {
      return 0.0;
   }
   ToLocal(stage);
   Vector forces(u.Size());
   Vector inflow(p.Size());
   forces = 0.0;
   inflow = 0.0;
   loads.AddLoads(ToLoads(stage), forces, inflow);
   return inflow.Sum();
}

std::optional<real_t> TotalLagrangianForm::Supply(const BodyStage &stage) const
{
   if (!materials.HasSupply())
   {
      return std::nullopt;
   }
   ToLocal(stage);
   real_t sum = 0.0;
   for (int e = 0; e < spaces.GetMesh().GetNE(); e++)
   {
      const Material &material =
         materials.Get(spaces.GetMesh().GetAttribute(e));
      if (!material.HasSupply())
      {
         continue;
      }
      element.Set(e, u, p);
      for (int q = 0; q < element.Points(); q++)
      {
         sum += element.Weight(q) * det(element.DeformationGradient(q)) *
                material.supply.Rate(element.Pressure(q));
      }
   }
   return sum;
}

void TotalLagrangianForm::AddMagnitudes(real_t dt, const Vector &u_magnitude,
                                        const Vector &p_magnitude,
                                        Vector &momentum, Vector &mass) const
{
   matrices.stiffness->AbsMult(1.0, u_magnitude, 1.0, momentum);
   matrices.divergence->AbsMult(1.0, u_magnitude, 1.0, mass);
   matrices.darcy->AbsMult(dt, p_magnitude, 1.0, mass);
   // Stresses at rest are differences of moduli, and volumes grow from 1.
   momentum += rest_momentum;
   mass += rest_mass;
}

bool TotalLagrangianForm::IsRigid(int number) const
{
   return materials.Get(spaces.GetMesh().GetAttribute(number)).IsRigid();
}

} // namespace synovia
