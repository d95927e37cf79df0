#include "synovia/fem/gravity_loads.hpp"
#include "synovia/fem/gradient_contraction.hpp"

#include <limits>

namespace synovia
{

using namespace mfem;

namespace
{
// Of the mixture, per undeformed volume.
real_t Density(const Material &material, real_t J)
{
   const real_t solid = material.HasFluid() ? material.solid_fraction : 1.0;
   return solid * material.solid_density +
          (material.HasFluid() ? (J - solid) * material.fluid_density : 0.0);
}

bool HasWeight(const Material &material)
{
   return !material.IsRigid() &&
          (material.solid_density > 0.0 ||
           (material.HasFluid() && material.fluid_density > 0.0));
}

bool DrivesFluid(const Material &material)
{
   return material.HasFluid() && material.fluid_density > 0.0;
}

// F^T b
Vector3<> PulledBack(const Tensor3<> &F, const Vector3<> &b)
{
   Vector3<> pulled;
   for (int c = 0; c < 3; c++)
   {
      pulled[c] = F[0][c] * b[0] + F[1][c] * b[1] + F[2][c] * b[2];
   }
   return pulled;
}

/// A density times a unit vector, by the table's materials.
class Weight : public VectorCoefficient
{
public:
   Weight(const MaterialTable &materials_, int axis_)
      : VectorCoefficient(3), materials(materials_), axis(axis_)
   {
   }
   void Eval(Vector &value, ElementTransformation &trans,
             const IntegrationPoint &) override
   {
      const Material &material = materials.Get(trans.Attribute);
      value.SetSize(3);
      value = 0.0;
      value[axis] = HasWeight(material) ? Density(material, 1.0) : 0.0;
   }

private:
   const MaterialTable &materials;
   int axis;
};

/// The flow that it drives.
class FlowByWeight : public VectorCoefficient
{
public:
   FlowByWeight(const MaterialTable &materials_, int axis_)
      : VectorCoefficient(3), materials(materials_), axis(axis_)
   {
   }
   void Eval(Vector &value, ElementTransformation &trans,
             const IntegrationPoint &ip) override
   {
      const Material &material = materials.Get(trans.Attribute);
      value.SetSize(3);
      value = 0.0;
      if (DrivesFluid(material))
      {
         value[axis] = material.fluid_density *
                       material.permeability->GetPermeability(trans, ip);
      }
   }

private:
   const MaterialTable &materials;
   int axis;
};
} // namespace

GravityLoads::GravityLoads(BiphasicSpaces &spaces_,
                           const MaterialTable &materials_,
                           const std::array<LoadCurve, 3> &acceleration_)
   : spaces(spaces_), materials(materials_), acceleration(acceleration_),
     element(spaces), permeability(spaces)
{
}

const DenseMatrix &GravityLoads::Shapes(int number) const
{
   const FiniteElement &fe = *spaces.Displacement().GetFE(number);
   DenseMatrix &shapes = shapes_of[fe.GetGeomType()];
   if (shapes.Width() == 0)
   {
      shapes.SetSize(fe.GetDof(), element.Points());
      for (int q = 0; q < element.Points(); q++)
      {
         Vector column(shapes.GetColumn(q), fe.GetDof());
         fe.CalcShape(element.Point(q).ip, column);
      }
   }
   return shapes;
}

Vector3<> GravityLoads::Acceleration(real_t t) const
{
   Vector3<> b;
   for (int d = 0; d < 3; d++)
   {
      b[d] = acceleration[d](t);
   }
   return b;
}

void GravityLoads::AddLoads(const FollowerLoads::State &state, Vector &forces,
                            Vector &inflow) const
{
   const Vector3<> b = Acceleration(state.t);
   Vector local;
   Vector flows;
   for (int e = 0; e < spaces.GetMesh().GetNE(); e++)
   {
      const Material &material =
         materials.Get(spaces.GetMesh().GetAttribute(e));
      if (!HasWeight(material))
      {
         continue;
      }
      element.Set(e, state.u, state.p);
      const DenseMatrix &shapes = Shapes(e);
      const int nodes = shapes.Height();
      local.SetSize(3 * nodes);
      local = 0.0;
      flows.SetSize(element.PressureDofs().Size());
      flows = 0.0;
      permeability.Set(element);
      for (int q = 0; q < element.Points(); q++)
      {
         const Tensor3<> F = element.DeformationGradient(q);
         const real_t weight = element.Weight(q) * Density(material, det(F));
         for (int k = 0; k < 3 * nodes; k++)
         {
            local[k] += weight * b[k / nodes] * shapes(k % nodes, q);
         }
         if (!DrivesFluid(material))
         {
            continue;
         }
         Tensor3<> conductance;
         const bool known =
            permeability.Get(element, *material.permeability, q, conductance);
         const real_t scale = known ? element.Weight(q) * material.fluid_density
                                    : std::numeric_limits<real_t>::quiet_NaN();
         const Vector3<> flow = Product(conductance, PulledBack(F, b));
         const DenseMatrix &gradients = element.PressureGradients();
         for (int k = 0; k < flows.Size(); k++)
         {
            for (int d = 0; d < 3; d++)
            {
               flows[k] += scale * gradients(k, 3 * q + d) * flow[d];
            }
         }
      }
      forces.AddElementVector(element.DisplacementDofs(), local);
      inflow.AddElementVector(element.PressureDofs(), flows);
   }
}

void GravityLoads::AddDerivatives(const FollowerLoads::State &state,
                                  AssembledMatrix &stiffness,
                                  AssembledMatrix &flow_change) const
{
   const Vector3<> b = Acceleration(state.t);
   DenseMatrix forces;
   DenseMatrix flows;
   Vector change;
   Vector mean_flow;
   for (int e = 0; e < spaces.GetMesh().GetNE(); e++)
   {
      const Material &material =
         materials.Get(spaces.GetMesh().GetAttribute(e));
      if (!HasWeight(material) || !DrivesFluid(material))
      {
         continue;
      }
      element.Set(e, state.u, state.p);
      const DenseMatrix &shapes = Shapes(e);
      const DenseMatrix &gradients = element.Gradients();
      const DenseMatrix &p_gradients = element.PressureGradients();
      const int nodes = shapes.Height();
      forces.SetSize(3 * nodes);
      flows.SetSize(p_gradients.Height(), 3 * nodes);
      forces = 0.0;
      flows = 0.0;
      change.SetSize(3 * nodes);
      mean_flow.SetSize(p_gradients.Height());
      mean_flow = 0.0;
      permeability.Set(element);
      for (int q = 0; q < element.Points(); q++)
      {
         const Tensor3<> F = element.DeformationGradient(q);
         const real_t weight = element.Weight(q) * material.fluid_density;
         ContractGradients(weight * Cofactor(F), gradients, q,
                           change.GetData());
         for (int j = 0; j < 3 * nodes; j++)
         {
            for (int k = 0; k < 3 * nodes; k++)
            {
               forces(k, j) -= b[k / nodes] * shapes(k % nodes, q) * change[j];
            }
         }
         Tensor3<> conductance;
         Tensor3<> by_mean{};
         Tangent3 tangent;
         if (!permeability.Linearize(element, *material.permeability, q,
                                     conductance, tangent, by_mean))
         {
            continue;
         }
         const Vector3<> way = PulledBack(F, b);
         const Vector3<> mean_flux =
            (weight * state.dt) * Product(by_mean, way);
         for (int a = 0; a < 3; a++)
         {
            Tensor3<> by_F{};
            for (int k = 0; k < 9; k++)
            {
               const int row = k / 3;
               const int column = k % 3;
               for (int c = 0; c < 3; c++)
               {
                  by_F[row][column] += tangent[3 * a + c][k] * way[c];
               }
               by_F[row][column] += conductance[a][column] * b[row];
            }
            ContractGradients((weight * state.dt) * by_F, gradients, q,
                              change.GetData());
            for (int j = 0; j < 3 * nodes; j++)
            {
               for (int k = 0; k < flows.Height(); k++)
               {
                  flows(k, j) -= p_gradients(k, 3 * q + a) * change[j];
               }
            }
            for (int k = 0; k < mean_flow.Size(); k++)
            {
               mean_flow[k] -= p_gradients(k, 3 * q + a) * mean_flux[a];
            }
         }
      }
      if (permeability.HasMean())
      {
         permeability.GetMeanChange(element, change);
         AddMultVWt(mean_flow, change, flows);
      }
      stiffness.Add(e, forces);
      flow_change.Add(e, flows);
   }
}

void AssembleGravity(BiphasicSpaces &spaces, const MaterialTable &materials,
                     int axis, Vector &forces, Vector &inflow)
{
   Weight weight(materials, axis);
   ParLinearForm momentum(&spaces.Displacement());
   momentum.AddDomainIntegrator(new VectorDomainLFIntegrator(weight));
   momentum.Assemble();
   forces.SetSize(spaces.Displacement().GetTrueVSize());
   momentum.ParallelAssemble(forces);
   FlowByWeight flow(materials, axis);
   ParLinearForm mass(&spaces.Pressure());
   mass.AddDomainIntegrator(new DomainLFGradIntegrator(flow));
   mass.Assemble();
   inflow.SetSize(spaces.Pressure().GetTrueVSize());
   mass.ParallelAssemble(inflow);
   forces.HostReadWrite();
   inflow.HostReadWrite();
}

} // namespace synovia
