#pragma once

#include "mfem.hpp"

#include "mfem/linalg/dual.hpp"
#include "mfem/linalg/tensor.hpp"

#include <cmath>

namespace synovia
{

/// Second-order tensors of space, [row][column], of numbers or of duals.
template <typename T = mfem::real_t>
using Tensor3 = mfem::future::tensor<T, 3, 3>;

template <typename T = mfem::real_t>
using Vector3 = mfem::future::tensor<T, 3>;

/// Derivatives of one second-order tensor by another: d A_ij / d F_kl is at
/// [3 i + j][3 k + l].
using Tangent3 = mfem::future::tensor<mfem::real_t, 9, 9>;

/// A number with its derivatives by the nine components of a tensor.
using Dual9 =
   mfem::future::dual<mfem::real_t, mfem::future::tensor<mfem::real_t, 9>>;

/// The matrix of cofactors, J F^-T.
template <typename T>
Tensor3<T> Cofactor(const Tensor3<T> &F)
{
   Tensor3<T> cofactor;
   for (int i = 0; i < 3; i++)
   {
      const int a = (i + 1) % 3;
      const int b = (i + 2) % 3;
      for (int j = 0; j < 3; j++)
      {
         const int c = (j + 1) % 3;
         const int d = (j + 2) % 3;
         cofactor[i][j] = F[a][c] * F[b][d] - F[a][d] * F[b][c];
      }
   }
   return cofactor;
}

/// The determinant, from the matrix of cofactors.
template <typename T>
T Determinant(const Tensor3<T> &F, const Tensor3<T> &cofactor)
{
   return F[0][0] * cofactor[0][0] + F[0][1] * cofactor[0][1] +
          F[0][2] * cofactor[0][2];
}

/// A B
template <typename S, typename T>
auto Product(const Tensor3<S> &A, const Tensor3<T> &B)
{
   Tensor3<decltype(A[0][0] * B[0][0])> product;
   for (int i = 0; i < 3; i++)
   {
      for (int j = 0; j < 3; j++)
      {
         product[i][j] =
            A[i][0] * B[0][j] + A[i][1] * B[1][j] + A[i][2] * B[2][j];
      }
   }
   return product;
}

/// A^T B
template <typename S, typename T>
auto TransposedProduct(const Tensor3<S> &A, const Tensor3<T> &B)
{
   Tensor3<decltype(A[0][0] * B[0][0])> product;
   for (int i = 0; i < 3; i++)
   {
      for (int j = 0; j < 3; j++)
      {
         product[i][j] =
            A[0][i] * B[0][j] + A[1][i] * B[1][j] + A[2][i] * B[2][j];
      }
   }
   return product;
}

/// A n
template <typename S, typename T>
auto Product(const Tensor3<S> &A, const Vector3<T> &n)
{
   Vector3<decltype(A[0][0] * n[0])> product;
   for (int i = 0; i < 3; i++)
   {
      product[i] = A[i][0] * n[0] + A[i][1] * n[1] + A[i][2] * n[2];
   }
   return product;
}

/// a . b
template <typename S, typename T>
auto InnerProduct(const Vector3<S> &a, const Vector3<T> &b)
{
   return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Adds @a factor a (x) b.
template <typename R, typename S, typename T, typename U>
void AddOuterProduct(const R &factor, const Vector3<S> &a, const Vector3<T> &b,
                     Tensor3<U> &sum)
{
   for (int i = 0; i < 3; i++)
   {
      for (int j = 0; j < 3; j++)
      {
         sum[i][j] = sum[i][j] + (factor * a[i]) * b[j];
      }
   }
}

template <typename T>
T Trace(const Tensor3<T> &A)
{
   return A[0][0] + A[1][1] + A[2][2];
}

inline Tensor3<> IdentityTensor()
{
   return {{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
}

inline bool IsFinite(const Tensor3<> &A)
{
   bool finite = true;
   for (int k = 0; k < 9; k++)
   {
      finite = finite && std::isfinite(A[k / 3][k % 3]);
   }
   return finite;
}

/// A number without its derivatives.
inline mfem::real_t ValueOf(mfem::real_t number)
{
   return number;
}
inline mfem::real_t ValueOf(const Dual9 &number)
{
   return number.value;
}

/// Rows and columns of a symmetric tensor's components in the order xx, yy, zz,
/// xy, yz, xz.
constexpr int symmetric_entries[6][2] = {{0, 0}, {1, 1}, {2, 2},
                                         {0, 1}, {1, 2}, {0, 2}};

/// The tensor as independent variable: component k has the derivative 1 by
/// itself.
inline Tensor3<Dual9> Independent(const Tensor3<> &F)
{
   Tensor3<Dual9> independent;
   for (int k = 0; k < 9; k++)
   {
      Dual9 &component = independent[k / 3][k % 3];
      component.value = F[k / 3][k % 3];
      component.gradient = {};
      component.gradient[k] = 1.0;
   }
   return independent;
}

/// Takes values and derivatives apart.
inline void Separate(const Tensor3<Dual9> &A, Tensor3<> &value,
                     Tangent3 &tangent)
{
   for (int k = 0; k < 9; k++)
   {
      value[k / 3][k % 3] = A[k / 3][k % 3].value;
      for (int l = 0; l < 9; l++)
      {
         tangent[k][l] = A[k / 3][k % 3].gradient[l];
      }
   }
}

} // namespace synovia
