// ranks: 1
//
// Stresses and tangents of solid laws against those of another program.

#include "support/law_samples.hpp"
#include "support/reference_table.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
// J^-1 F F F F : 4 d^2 Psi/dC dC, from dP/dF.
real_t SpatialTangent(const Tensor3<> &F, const Tensor3<> &cauchy,
                      const Tangent3 &tangent, const int (&ij)[2],
                      const int (&kl)[2])
{
   const real_t J = Determinant(F, Cofactor(F));
   real_t sum = 0.0;
   for (int b = 0; b < 3; b++)
   {
      for (int d = 0; d < 3; d++)
      {
         sum += F[ij[1]][b] * F[kl[1]][d] *
                tangent[3 * ij[0] + b][3 * kl[0] + d] / J;
      }
   }
   return sum - (ij[0] == kl[0] ? cauchy[ij[1]][kl[1]] : 0.0);
}

void CheckOracle(int number, const SolidLaw &law)
{
   const ReferenceTable table("law_oracles.csv");
   const char *const columns[6] = {"xx", "yy", "zz", "xy", "yz", "xz"};
   const auto expected = [&](int row, int column)
   {
      return table.Find({{"law", real_t(number)}, {"row", real_t(row)}},
                        columns[column]);
   };
   const Tensor3<> F = SomeDeformation();
   Tangent3 tangent;
   const Tensor3<> cauchy = PushedForward(StressOf(law, F, &tangent), F);
   real_t largest = 0.0;
   for (int v = 0; v < 6; v++)
   {
      CAPTURE(v);
      CHECK(cauchy[voigt_pairs[v][0]][voigt_pairs[v][1]] ==
            Approx(expected(0, v)).epsilon(1e-10));
      for (int w = 0; w < 6; w++)
      {
         largest = std::max(largest, std::abs(expected(1 + v, w)));
      }
   }
   for (int v = 0; v < 6; v++)
   {
      for (int w = 0; w < 6; w++)
      {
         CAPTURE(v, w);
         const real_t found =
            SpatialTangent(F, cauchy, tangent, voigt_pairs[v], voigt_pairs[w]);
         CHECK(std::abs(found - expected(1 + v, w)) < 1e-10 * largest);
      }
   }
}
} // namespace

TEST_CASE("Stresses and tangents are those of another program", "[laws]")
{
   CheckOracle(0, *SampledLaw("neo_hookean", {{"E", 1.0}, {"nu", 0.3}}));
   CheckOracle(
      1, *SampledLaw("holmes_mow", {{"E", 1.0}, {"nu", 0.2}, {"beta", 0.35}}));
   CheckOracle(2, *SampledLaw("porous_neo_hookean", {{"E", 0.5}}));
   CheckOracle(
      3,
      *SampledLaw("fiber_exp_pow",
                  {{"alpha", 1.0}, {"beta", 2.0}, {"ksi", 5.0}, {"mu", 0.2}}));
   CheckOracle(4, *SampledLaw("fiber_exp_pow",
                              {{"alpha", 0.0}, {"beta", 2.5}, {"ksi", 5.0}}));
}
