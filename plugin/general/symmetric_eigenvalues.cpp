#include "synovia/general/symmetric_eigenvalues.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace synovia
{

using namespace mfem;

namespace
{
// Rotates rows and columns p and q so that a(p, q) becomes zero.
void Rotate(DenseMatrix &a, int p, int q)
{
   const real_t theta = 0.5 * (a(q, q) - a(p, p)) / a(p, q);
   const real_t t = std::copysign(1.0, theta) /
                    (std::abs(theta) + std::sqrt(theta * theta + 1.0));
   const real_t c = 1.0 / std::sqrt(t * t + 1.0);
   const real_t s = t * c;
   for (int k = 0; k < a.Height(); k++)
   {
      const real_t kp = a(k, p);
      const real_t kq = a(k, q);
      a(k, p) = c * kp - s * kq;
      a(k, q) = s * kp + c * kq;
   }
   for (int k = 0; k < a.Height(); k++)
   {
      const real_t pk = a(p, k);
      const real_t qk = a(q, k);
      a(p, k) = c * pk - s * qk;
      a(q, k) = s * pk + c * qk;
   }
}
} // namespace

Vector SymmetricEigenvalues(DenseMatrix matrix)
{
   if (matrix.CheckFinite() > 0)
   {
      Vector none(matrix.Height());
      none = std::numeric_limits<real_t>::quiet_NaN();
      return none;
   }
   constexpr int most_sweeps = 30;
   constexpr real_t round_off = 1e-15;
   const real_t scale = matrix.MaxMaxNorm();
   bool diagonal = false;
   for (int sweep = 0; sweep < most_sweeps && !diagonal; sweep++)
   {
      diagonal = true;
      for (int p = 0; p < matrix.Height(); p++)
      {
         for (int q = p + 1; q < matrix.Height(); q++)
         {
            if (std::abs(matrix(p, q)) > round_off * scale)
            {
               Rotate(matrix, p, q);
               diagonal = false;
            }
         }
      }
   }
   Vector eigenvalues;
   matrix.GetDiag(eigenvalues);
   std::sort(eigenvalues.begin(), eigenvalues.end());
   return eigenvalues;
}

} // namespace synovia
