#include "synovia/fem/effective_stress_integrator.hpp"
#include "synovia/fem/quadrature_order.hpp"

namespace synovia
{

using namespace mfem;

const IntegrationRule &
EffectiveStressIntegrator::Rule(const FiniteElement &el,
                                const ElementTransformation &trans)
{
   return IntRules.Get(el.GetGeomType(),
                       QuadratureOrder(el, trans, 2 * trans.OrderGrad(&el)));
}

void EffectiveStressIntegrator::AssembleElementMatrix(
   const FiniteElement &el, ElementTransformation &trans, DenseMatrix &elmat)
{
   const int dofs = el.GetDof();
   elmat.SetSize(3 * dofs);
   elmat = 0.0;
   const SolidLaw &law = *materials.Get(trans.Attribute).solid;
   const IntegrationRule &rule = IntRule ? *IntRule : Rule(el, trans);
   const DofToQuad &maps = el.GetDofToQuad(rule, DofToQuad::FULL);
   const int points = rule.GetNPoints();
   reference.SetSize(dofs, 3);
   gradients.SetSize(dofs, 3);
   for (int q = 0; q < points; q++)
   {
      const IntegrationPoint &ip = rule.IntPoint(q);
      trans.SetIntPoint(&ip);
      for (int d = 0; d < 3; d++)
      {
         for (int i = 0; i < dofs; i++)
         {
            reference(i, d) = maps.G[q + points * (d + 3 * i)];
         }
      }
      Mult(reference, trans.InverseJacobian(), gradients);
      law.GetStiffness(trans, ip, stiffness);
      stiffness *= ip.weight * trans.Weight();
      AddPoint(elmat);
   }
}

void EffectiveStressIntegrator::AddPoint(DenseMatrix &elmat) const
{
   // Where d u_a / d x_d is among the strains, and the stress that it works on.
   constexpr int voigt[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
   const int dofs = gradients.Height();
   const real_t *const dx = gradients.GetColumn(0);
   const real_t *const dy = gradients.GetColumn(1);
   const real_t *const dz = gradients.GetColumn(2);
   for (int b = 0; b < 3; b++)
   {
      for (int j = 0; j < dofs; j++)
      {
         real_t stress[6];
         for (int k = 0; k < 6; k++)
         {
            stress[k] = stiffness(k, voigt[b][0]) * dx[j] +
                        stiffness(k, voigt[b][1]) * dy[j] +
                        stiffness(k, voigt[b][2]) * dz[j];
         }
         for (int a = 0; a < 3; a++)
         {
            const real_t along_x = stress[voigt[a][0]];
            const real_t along_y = stress[voigt[a][1]];
            const real_t along_z = stress[voigt[a][2]];
            real_t *const force = elmat.GetColumn(j + b * dofs) + a * dofs;
            for (int i = 0; i < dofs; i++)
            {
               force[i] += dx[i] * along_x + dy[i] * along_y + dz[i] * along_z;
            }
         }
      }
   }
}

} // namespace synovia
