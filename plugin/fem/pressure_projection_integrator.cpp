#include "synovia/fem/pressure_projection_integrator.hpp"
#include "synovia/fem/quadrature_order.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

namespace
{
/// The least factor of the stabilization, times H_A, for which the pressure of
/// a column loaded at once does not oscillate. For linear elements in one
/// dimension, of height h, momentum and mass balance of an undrained step
/// together have the matrix
///
///    h/(4 H_A) [1 1; 1 1] + factor h/12 [1 -1; -1 1],
///
/// which has no positive entries off the diagonal from 3/H_A on; hexahedra are
/// the same. The others have been measured
/// (tests/verification/stabilization.cpp).
real_t LeastFactor(Geometry::Type geometry)
{
   switch (geometry)
   {
   case Geometry::CUBE:
      return 3.0;
   case Geometry::PRISM:
      return 5.0;
   default:
      return 8.0;
   }
}
} // namespace

void PressureProjectionIntegrator::AssembleElementMatrix(
   const FiniteElement &el, ElementTransformation &trans, DenseMatrix &elmat)
{
   const int dofs = el.GetDof();
   shape.SetSize(dofs);
   integral.SetSize(dofs);
   integral = 0.0;
   elmat.SetSize(dofs);
   elmat = 0.0;
   const Material &material = materials.Get(trans.Attribute);
   if (!material.HasFluid())
   {
      return;
   }
   const SolidLaw &law = *material.solid;
   const real_t scale =
      factor * std::max(0.5 / law.ShearModulus(),
                        LeastFactor(el.GetGeomType()) / law.AggregateModulus());
   const IntegrationRule &rule =
      IntRule ? *IntRule
              : IntRules.Get(el.GetGeomType(),
                             QuadratureOrder(
                                el, trans, 2 * el.GetOrder() + trans.OrderW()));
   real_t volume = 0.0;
   for (int q = 0; q < rule.GetNPoints(); q++)
   {
      const IntegrationPoint &ip = rule.IntPoint(q);
      trans.SetIntPoint(&ip);
      el.CalcShape(ip, shape);
      const real_t weight = ip.weight * trans.Weight();
      volume += weight;
      integral.Add(weight, shape);
      AddMult_a_VVt(scale * weight, shape, elmat);
   }
   AddMult_a_VVt(-scale / volume, integral, elmat);
}

} // namespace synovia
