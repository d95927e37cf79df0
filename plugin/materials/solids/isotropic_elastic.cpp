#include "synovia/materials/solids/isotropic_elastic.hpp"

namespace synovia
{

using namespace mfem;

void IsotropicElastic::GetStiffness(ElementTransformation &,
                                    const IntegrationPoint &,
                                    DenseMatrix &stiffness) const
{
   stiffness.SetSize(6);
   stiffness = 0.0;
   for (int i = 0; i < 3; i++)
   {
      for (int j = 0; j < 3; j++)
      {
         stiffness(i, j) = moduli.lambda;
      }
      stiffness(i, i) += 2.0 * moduli.mu;
      stiffness(i + 3, i + 3) = moduli.mu;
   }
}

} // namespace synovia
