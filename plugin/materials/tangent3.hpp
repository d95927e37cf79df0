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

/// The derivatives by F of the component k of a tensor, at [k / 3][k % 3].
inline Tensor3<> ComponentDerivative(const Tangent3 &tangent, int component)
{
   Tensor3<> row;
   for (int k = 0; k < 9; k++)
   {
      row[k / 3][k % 3] = tangent[component][k];
   }
   return row;
}

/// Adds @a factor x A (x) B: the derivative of A f, where B = df/dF.
inline void AddDyad(mfem::real_t factor, const Tensor3<> &A, const Tensor3<> &B,
                    Tangent3 &tangent)
{
   for (int k = 0; k < 9; k++)
   {
      const mfem::real_t row = factor * A[k / 3][k % 3];
      for (int l = 0; l < 9; l++)
      {
         tangent[k][l] += row * B[l / 3][l % 3];
      }
   }
}

/// (dA/dF) : F, the derivative of A by a factor of F.
inline Tensor3<> AlongDeformation(const Tangent3 &tangent, const Tensor3<> &F)
{
   Tensor3<> along{};
   for (int k = 0; k < 9; k++)
   {
      for (int l = 0; l < 9; l++)
      {
         along[k / 3][k % 3] += tangent[k][l] * F[l / 3][l % 3];
      }
   }
   return along;
}

/// Adds @a factor x dF/dF.
inline void AddIdentity(mfem::real_t factor, Tangent3 &tangent)
{
   for (int k = 0; k < 9; k++)
   {
      tangent[k][k] += factor;
   }
}

} // namespace synovia
