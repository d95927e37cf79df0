// ranks: 1
//
// Solid laws of what is in the pores: none left, and fixed charges.

#include "support/law_samples.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

TEST_CASE("A porous solid has no stress without pores", "[laws]")
{
   const SampledLaw porous("porous_neo_hookean", {{"E", 0.5}});
   Tensor3<> closed = IdentityTensor();
   closed[2][2] = 0.19;
   AnyPoint point;
   Tensor3<> P;
   CHECK_FALSE(porous->GetStress(point.Get(), closed, P, nullptr));
   closed[2][2] = 0.2001;
   CHECK(porous->GetStress(point.Get(), closed, P, nullptr));
   CHECK(P[2][2] < -100.0);
}

TEST_CASE("Fixed charges press", "[laws]")
{
   // p = 8.314e-6 310 (sqrt(150^2 + 300^2) - 300) in MPa
   const real_t pressure = 8.314e-6 * 310.0 * 35.410196624968454;
   const std::map<std::string, real_t> values{{"phiw0", 0.8},
                                              {"cF0", 150.0},
                                              {"bosm", 300.0},
                                              {"R", 8.314e-6},
                                              {"T", 310.0}};
   const SampledLaw donnan("donnan", values);
   Tangent3 tangent;
   const Tensor3<> P = StressOf(*donnan, IdentityTensor(), &tangent);
   for (int k = 0; k < 9; k++)
   {
      CHECK(P[k / 3][k % 3] ==
            Approx(k / 3 == k % 3 ? -pressure : 0.0).epsilon(1e-12));
   }
   // The charges get closer as fluid leaves.
   const real_t J = 0.7;
   const real_t charge = 0.8 * 150.0 / (J - 0.2);
   const Tensor3<> pressed{{{J, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
   CHECK(StressOf(*donnan, pressed)[0][0] ==
         Approx(-8.314e-6 * 310.0 * (std::hypot(charge, 300.0) - 300.0)));
   CHECK(donnan->AggregateModulus() == Approx(tangent[0][0]));
   CHECK(donnan->ShearModulus() == 0.0);
   AnyPoint point;
   Tensor3<> closed = IdentityTensor();
   closed[2][2] = 0.2;
   Tensor3<> stress;
   CHECK_FALSE(donnan->GetStress(point.Get(), closed, stress, nullptr));
   CHECK_THROWS_WITH(Donnan({1.0, 150.0, 300.0, 1.0, 1.0}),
                     "the volume fraction phiw0 of the fluid is 1; it must be "
                     "between 0 and 1");
}
