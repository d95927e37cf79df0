#include "synovia/materials/linear_solid.hpp"

namespace synovia
{

using namespace mfem;

bool LinearSolid::GetStress(const MaterialPoint &point, const Tensor3<> &F,
                            Tensor3<> &stress, Tangent3 *tangent) const
{
   constexpr int voigt[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
   DenseMatrix stiffness;
   GetStiffness(point.trans, point.ip, stiffness);
   const Tensor3<> identity = IdentityTensor();
   stress = Tensor3<>{};
   for (int k = 0; k < 9; k++)
   {
      const int row = voigt[k / 3][k % 3];
      for (int l = 0; l < 9; l++)
      {
         const real_t modulus = stiffness(row, voigt[l / 3][l % 3]);
         stress[k / 3][k % 3] +=
            modulus * (F[l / 3][l % 3] - identity[l / 3][l % 3]);
         if (tangent)
         {
            (*tangent)[k][l] = modulus;
         }
      }
   }
   return true;
}

} // namespace synovia
