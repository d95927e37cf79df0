#include "synovia/fem/element_tangent.hpp"
#include "synovia/fem/gradient_contraction.hpp"
#include "synovia/materials/tangent3.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

namespace
{
// The change of component a of the flow K grad p with F.
Tensor3<> FlowChange(const Tangent3 &tangent, const Vector3<> &grad_p, int a)
{
   return grad_p[0] * ComponentDerivative(tangent, 3 * a) +
          grad_p[1] * ComponentDerivative(tangent, 3 * a + 1) +
          grad_p[2] * ComponentDerivative(tangent, 3 * a + 2);
}
} // namespace

bool ElementTangent::GetSolidTangent(BodyElement &element,
                                     const Material &material, int q,
                                     Tangent3 &solid)
{
   const Tensor3<> F = element.DeformationGradient(q);
   if (material.mean_dilatation)
   {
      solid = mean_dilatation.Tangent(q);
      return true;
   }
   Tensor3<> stress;
   return det(F) > 0.0 &&
          material.solid->GetStress(element.Point(q), F, stress, &solid);
}

void ElementTangent::AddSupply(BodyElement &element, const FluidSupply &supply,
                               real_t dt)
{
   const DenseMatrix &shapes = element.PressureShapes();
   supplies.SetSize(shapes.Height(), shapes.Width());
   for (int q = 0; q < element.Points(); q++)
   {
      const real_t change = dt * supply.Rate(element.Pressure(q));
      for (int k = 0; k < volume_changes.Height(); k++)
      {
         volume_changes(k, q) *= -change;
      }
      const real_t share =
         supply.kp * element.Weight(q) * det(element.DeformationGradient(q));
      for (int k = 0; k < supplies.Height(); k++)
      {
         supplies(k, q) = share * shapes(k, q);
      }
   }
   AddMultABt(shapes, volume_changes, flow_change);
   AddMultABt(shapes, supplies, darcy);
}

void ElementTangent::AddMeanCoupling(BodyElement &element)
{
   Vector mean_change;
   permeability.GetMeanChange(element, mean_change);
   AddMultVWt(mean_flow, mean_change, flow_change);
}

bool ElementTangent::Compute(BodyElement &element, const Material &material,
                             real_t dt)
{
   if (material.mean_dilatation &&
       !mean_dilatation.Linearize(element, *material.solid))
   {
      return false;
   }
   const bool wet = material.HasFluid();
   const DenseMatrix &gradients = element.Gradients();
   const DenseMatrix &p_gradients = element.PressureGradients();
   const int nodes = gradients.Height();
   const int p_dofs = p_gradients.Height();
   const int points = element.Points();
   stress_changes.SetSize(9 * nodes, 3 * points);
   volume_changes.SetSize(3 * nodes, points);
   flow_changes.SetSize(3 * nodes, 3 * points);
   flows.SetSize(p_dofs, 3 * points);
   mean_flow.SetSize(p_dofs);
   mean_flow = 0.0;
   if (wet)
   {
      permeability.Set(element);
   }
   Tensor3<> value;
   Tensor3<> by_mean{};
   Tangent3 tangent;
   for (int q = 0; q < points; q++)
   {
      const real_t weight = element.Weight(q);
      const Tensor3<> F = element.DeformationGradient(q);
      if (!GetSolidTangent(element, material, q, tangent))
      {
         return false;
      }
      if (wet)
      {
         tangent -= element.Pressure(q) * CofactorDerivative(F);
      }
      tangent = weight * tangent;
      for (int c = 0; c < 3; c++)
      {
         for (int a = 0; a < 3; a++)
         {
            ContractGradients(
               ComponentDerivative(tangent, 3 * a + c), gradients, q,
               stress_changes.GetColumn(3 * q + c) + 3 * nodes * a);
         }
      }
      if (!wet)
      {
         continue;
      }
      ContractGradients(weight * Cofactor(F), gradients, q,
                        volume_changes.GetColumn(q));
      if (!permeability.Linearize(element, *material.permeability, q, value,
                                  tangent, by_mean))
      {
         return false;
      }
      tangent = (weight * dt) * tangent;
      value = weight * value;
      const Vector3<> grad_p = element.PressureGradient(q);
      const Vector3<> mean_flux = (weight * dt) * Product(by_mean, grad_p);
      for (int a = 0; a < 3; a++)
      {
         ContractGradients(FlowChange(tangent, grad_p, a), gradients, q,
                           flow_changes.GetColumn(3 * q + a));
         const real_t *const gradient = p_gradients.GetColumn(3 * q + a);
         for (int k = 0; k < p_dofs; k++)
         {
            mean_flow[k] += mean_flux[a] * gradient[k];
         }
      }
      ContractGradients(value, p_gradients, q, flows.GetColumn(3 * q));
   }

   stiffness_rows.SetSize(nodes, 9 * nodes);
   MultABt(gradients, stress_changes, stiffness_rows);
   stiffness.SetSize(3 * nodes);
   for (int a = 0; a < 3; a++)
   {
      for (int j = 0; j < 3 * nodes; j++)
      {
         const real_t *const rows = stiffness_rows.GetColumn(3 * nodes * a + j);
         std::copy(rows, rows + nodes, stiffness.GetColumn(j) + a * nodes);
      }
   }
   if (material.mean_dilatation)
   {
      mean_dilatation.AddCoupling(element, stiffness);
   }
   growth.SetSize(p_dofs, 3 * nodes);
   flow_change.SetSize(p_dofs, 3 * nodes);
   darcy.SetSize(p_dofs);
   if (!wet)
   {
      growth = 0.0;
      flow_change = 0.0;
      darcy = 0.0;
      return true;
   }
   MultABt(element.PressureShapes(), volume_changes, growth);
   MultABt(p_gradients, flow_changes, flow_change);
   if (permeability.HasMean())
   {
      AddMeanCoupling(element);
   }
   MultABt(p_gradients, flows, darcy);
   if (material.HasSupply())
   {
      AddSupply(element, material.supply, dt);
   }
   return true;
}

} // namespace synovia
