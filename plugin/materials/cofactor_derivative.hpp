#pragma once

#include "synovia/materials/tensor3.hpp"

namespace synovia
{

/// d(J F^-T)/dF, which is linear in F.
inline Tangent3 CofactorDerivative(const Tensor3<> &F)
{
   constexpr int sign[3][3] = {{0, 1, -1}, {-1, 0, 1}, {1, -1, 0}};
   Tangent3 derivative{};
   for (int i = 0; i < 3; i++)
   {
      for (int k = 0; k < 3; k++)
      {
         for (int j = 0; j < 3 && k != i; j++)
         {
            for (int l = 0; l < 3; l++)
            {
               if (l != j)
               {
                  derivative[3 * i + j][3 * k + l] =
                     sign[i][k] * sign[j][l] * F[3 - i - k][3 - j - l];
               }
            }
         }
      }
   }
   return derivative;
}

} // namespace synovia
