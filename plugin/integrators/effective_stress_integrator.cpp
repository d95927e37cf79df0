#include "integrators/effective_stress_integrator.hpp"

namespace synovia
{

using namespace mfem;

void CalcStrainMatrix(const DenseMatrix &dshape, DenseMatrix &strain)
{
   const int dofs = dshape.Height();
   strain.SetSize(6, 3 * dofs);
   strain = 0.0;
   for (int i = 0; i < dofs; i++)
   {
      const int x = i;
      const int y = i + dofs;
      const int z = i + 2 * dofs;
      strain(0, x) = dshape(i, 0);
      strain(1, y) = dshape(i, 1);
      strain(2, z) = dshape(i, 2);
      strain(3, x) = dshape(i, 1);
      strain(3, y) = dshape(i, 0);
      strain(4, y) = dshape(i, 2);
      strain(4, z) = dshape(i, 1);
      strain(5, x) = dshape(i, 2);
      strain(5, z) = dshape(i, 0);
   }
}

void EffectiveStressIntegrator::AssembleElementMatrix(
   const FiniteElement &el, ElementTransformation &trans, DenseMatrix &elmat)
{
   const int dofs = el.GetDof();
   dshape.SetSize(dofs, 3);
   elmat.SetSize(3 * dofs);
   elmat = 0.0;
   const SolidLaw &law = *materials.Get(trans.Attribute).solid;
   const IntegrationRule &rule =
      IntRule ? *IntRule
              : IntRules.Get(el.GetGeomType(), 2 * trans.OrderGrad(&el));
   for (int q = 0; q < rule.GetNPoints(); q++)
   {
      const IntegrationPoint &ip = rule.IntPoint(q);
      trans.SetIntPoint(&ip);
      el.CalcPhysDShape(trans, dshape);
      CalcStrainMatrix(dshape, strain);
      law.GetStiffness(trans, ip, stiffness);
      stiffness *= ip.weight * trans.Weight();
      stress.SetSize(6, 3 * dofs);
      Mult(stiffness, strain, stress);
      AddMultAtB(strain, stress, elmat);
   }
}

} // namespace synovia
