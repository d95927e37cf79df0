#pragma once

#include "synovia/materials/tensor3.hpp"

namespace synovia
{

/// Sets contracted_bj = sum_d A_bd g_jd at [b dofs + j], with the gradients g_j
/// of shape functions at a point: dofs x (3 x points), the components of a
/// point one after the other.
inline void ContractGradients(const Tensor3<> &A,
                              const mfem::DenseMatrix &gradients, int point,
                              mfem::real_t *contracted)
{
   const int dofs = gradients.Height();
   const mfem::real_t *const g = gradients.GetColumn(3 * point);
   for (int b = 0; b < 3; b++)
   {
      for (int j = 0; j < dofs; j++)
      {
         contracted[b * dofs + j] =
            A[b][0] * g[j] + A[b][1] * g[dofs + j] + A[b][2] * g[2 * dofs + j];
      }
   }
}

} // namespace synovia
