#include "synovia/materials/solid_law.hpp"

namespace synovia
{

using namespace mfem;

void SolidLaw::GetStiffness(ElementTransformation &trans,
                            const IntegrationPoint &ip,
                            DenseMatrix &stiffness) const
{
   // Components of a tensor in the order of Voigt's, as 3 i + j.
   constexpr int voigt[6] = {0, 4, 8, 1, 5, 2};
   Tensor3<> stress;
   Tangent3 tangent;
   GetStress({trans, ip}, IdentityTensor(), stress, &tangent);
   stiffness.SetSize(6);
   for (int i = 0; i < 6; i++)
   {
      for (int j = 0; j < 6; j++)
      {
         stiffness(i, j) = tangent[voigt[i]][voigt[j]];
      }
   }
}

} // namespace synovia
