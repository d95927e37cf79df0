// ranks: 1
//
// Eigenvalues without LAPACK.

#include "synovia/general/symmetric_eigenvalues.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using namespace mfem;
using namespace synovia;

TEST_CASE("Eigenvalues of a second difference are sines")
{
   for (const int n : {1, 2, 6, 20})
   {
      DenseMatrix matrix(n);
      matrix = 0.0;
      for (int i = 0; i < n; i++)
      {
         matrix(i, i) = 2.0;
         if (i > 0)
         {
            matrix(i, i - 1) = matrix(i - 1, i) = -1.0;
         }
      }
      const Vector eigenvalues = SymmetricEigenvalues(matrix);
      REQUIRE(eigenvalues.Size() == n);
      for (int i = 0; i < n; i++)
      {
         const real_t sine = std::sin(0.5 * M_PI * (i + 1) / (n + 1));
         CHECK(eigenvalues[i] == Approx(4.0 * sine * sine).epsilon(1e-13));
      }
   }
}

TEST_CASE("Small eigenvalues beside large ones keep their sign")
{
   // Rotated by 30 degrees; round-off is that of the larger one, 1e-8.
   const real_t c = std::cos(M_PI / 6.0);
   const real_t s = std::sin(M_PI / 6.0);
   for (const real_t small : {-1e-3, 1e-3})
   {
      DenseMatrix matrix(2);
      matrix(0, 0) = c * c * 1e8 + s * s * small;
      matrix(1, 1) = s * s * 1e8 + c * c * small;
      matrix(0, 1) = matrix(1, 0) = c * s * (1e8 - small);
      const Vector eigenvalues = SymmetricEigenvalues(matrix);
      CHECK(eigenvalues[0] == Approx(small).epsilon(1e-3));
      CHECK(eigenvalues[1] == Approx(1e8).epsilon(1e-14));
   }
}

TEST_CASE("What is not finite has no eigenvalues")
{
   DenseMatrix matrix(3);
   matrix = 0.0;
   matrix(1, 2) = matrix(2, 1) = std::numeric_limits<real_t>::quiet_NaN();
   const Vector eigenvalues = SymmetricEigenvalues(matrix);
   REQUIRE(eigenvalues.Size() == 3);
   for (const real_t value : eigenvalues)
   {
      CHECK(std::isnan(value));
   }
}
