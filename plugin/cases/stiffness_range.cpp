#include "cases/stiffness_range.hpp"

#include <algorithm>
#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
constexpr int size = 6;

// Rotates rows and columns p and q so that a(p, q) becomes zero.
void Rotate(DenseMatrix &a, int p, int q)
{
   const real_t theta = 0.5 * (a(q, q) - a(p, p)) / a(p, q);
   const real_t t = std::copysign(1.0, theta) /
                    (std::abs(theta) + std::sqrt(theta * theta + 1.0));
   const real_t c = 1.0 / std::sqrt(t * t + 1.0);
   const real_t s = t * c;
   for (int k = 0; k < size; k++)
   {
      const real_t kp = a(k, p);
      const real_t kq = a(k, q);
      a(k, p) = c * kp - s * kq;
      a(k, q) = s * kp + c * kq;
   }
   for (int k = 0; k < size; k++)
   {
      const real_t pk = a(p, k);
      const real_t qk = a(q, k);
      a(p, k) = c * pk - s * qk;
      a(q, k) = s * pk + c * qk;
   }
}

// Jacobi's method: leaves the eigenvalues on the diagonal.
void Diagonalise(DenseMatrix &a)
{
   constexpr int sweeps = 30;
   const real_t scale = a.MaxMaxNorm();
   for (int sweep = 0; sweep < sweeps; sweep++)
   {
      real_t off_diagonal = 0.0;
      for (int p = 0; p < size; p++)
      {
         for (int q = p + 1; q < size; q++)
         {
            off_diagonal = std::max(off_diagonal, std::abs(a(p, q)));
            if (std::abs(a(p, q)) > 1e-15 * scale)
            {
               Rotate(a, p, q);
            }
         }
      }
      if (off_diagonal <= 1e-15 * scale)
      {
         return;
      }
   }
}
} // namespace

StiffnessRange RangeOfStiffness(const SolidLaw &law,
                                ElementTransformation &trans)
{
   const IntegrationPoint &centre =
      Geometries.GetCenter(trans.GetGeometryType());
   trans.SetIntPoint(&centre);
   DenseMatrix stiffness;
   law.GetStiffness(trans, centre, stiffness);
   // With shear strains times sqrt(2) the tensors' product is the vectors'.
   for (int i = 0; i < size; i++)
   {
      for (int j = 0; j < size; j++)
      {
         stiffness(i, j) *=
            (i < 3 ? 1.0 : std::sqrt(2.0)) * (j < 3 ? 1.0 : std::sqrt(2.0));
      }
   }
   Diagonalise(stiffness);
   StiffnessRange range{stiffness(0, 0), stiffness(0, 0)};
   for (int i = 1; i < size; i++)
   {
      range.least = std::min(range.least, stiffness(i, i));
      range.largest = std::max(range.largest, stiffness(i, i));
   }
   return range;
}

} // namespace synovia
