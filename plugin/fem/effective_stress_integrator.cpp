#include "synovia/fem/effective_stress_integrator.hpp"
#include "synovia/fem/quadrature_order.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
// Where d u_a / d x_d is among the strains, and the stress that it works on.
constexpr int strain_index[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
} // namespace

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
   const Material &material = materials.Get(trans.Attribute);
   if (material.IsRigid())
   {
      return;
   }
   const SolidLaw &law = *material.solid;
   const IntegrationRule &rule = IntRule ? *IntRule : Rule(el, trans);
   const DofToQuad &maps = el.GetDofToQuad(rule, DofToQuad::FULL);
   const int points = rule.GetNPoints();
   if (material.mean_dilatation)
   {
      FindMeanGradients(maps, rule, trans);
   }
   for (int q = 0; q < points; q++)
   {
      const IntegrationPoint &ip = rule.IntPoint(q);
      trans.SetIntPoint(&ip);
      FindGradients(maps, q, trans);
      law.GetStiffness(trans, ip, stiffness);
      stiffness *= ip.weight * trans.Weight();
      if (material.mean_dilatation)
      {
         AddPointOfMeanDilatation(elmat);
      }
      else
      {
         AddPoint(elmat);
      }
   }
}

void EffectiveStressIntegrator::FindGradients(const DofToQuad &maps, int point,
                                              ElementTransformation &trans)
{
   reference.SetSize(maps.ndof, 3);
   gradients.SetSize(maps.ndof, 3);
   for (int d = 0; d < 3; d++)
   {
      for (int i = 0; i < maps.ndof; i++)
      {
         reference(i, d) = maps.G[point + maps.nqpt * (d + 3 * i)];
      }
   }
   Mult(reference, trans.InverseJacobian(), gradients);
}

void EffectiveStressIntegrator::FindMeanGradients(const DofToQuad &maps,
                                                  const IntegrationRule &rule,
                                                  ElementTransformation &trans)
{
   real_t volume = 0.0;
   mean_gradients.SetSize(maps.ndof, 3);
   mean_gradients = 0.0;
   for (int q = 0; q < maps.nqpt; q++)
   {
      const IntegrationPoint &ip = rule.IntPoint(q);
      trans.SetIntPoint(&ip);
      FindGradients(maps, q, trans);
      const real_t weight = ip.weight * trans.Weight();
      volume += weight;
      mean_gradients.Add(weight, gradients);
   }
   mean_gradients *= 1.0 / volume;
}

void EffectiveStressIntegrator::AddPointOfMeanDilatation(
   DenseMatrix &elmat) const
{
   const int dofs = gradients.Height();
   DenseMatrix strains(6, 3 * dofs);
   strains = 0.0;
   for (int b = 0; b < 3; b++)
   {
      for (int j = 0; j < dofs; j++)
      {
         real_t *const strain = strains.GetColumn(j + b * dofs);
         for (int d = 0; d < 3; d++)
         {
            strain[strain_index[b][d]] = gradients(j, d);
         }
         const real_t more = (mean_gradients(j, b) - gradients(j, b)) / 3.0;
         for (int k = 0; k < 3; k++)
         {
            strain[k] += more;
         }
      }
   }
   DenseMatrix stresses(6, 3 * dofs);
   Mult(stiffness, strains, stresses);
   AddMultAtB(strains, stresses, elmat);
}

void EffectiveStressIntegrator::AddPoint(DenseMatrix &elmat) const
{
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
            stress[k] = stiffness(k, strain_index[b][0]) * dx[j] +
                        stiffness(k, strain_index[b][1]) * dy[j] +
                        stiffness(k, strain_index[b][2]) * dz[j];
         }
         for (int a = 0; a < 3; a++)
         {
            const real_t along_x = stress[strain_index[a][0]];
            const real_t along_y = stress[strain_index[a][1]];
            const real_t along_z = stress[strain_index[a][2]];
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
