// ranks: 1
//
// The solid laws that are registered: stresses against complex-step derivatives
// of the energies, tangents against differences of stresses, small strains, and
// a body that turns.

#include "support/law_samples.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <set>

using namespace mfem;
using namespace synovia;

TEST_CASE("Each law has its energy among the samples", "[laws]")
{
   std::set<std::string> sampled;
   for (const LawSample &sample : LawSamples())
   {
      sampled.insert(sample.name);
   }
   sampled.insert("mixture");
   // In fiber_distributions.cpp
   sampled.insert("continuous_fiber_distribution");
   sampled.insert("ellipsoidal_fiber_distribution");
   const std::vector<std::string> names =
      SolidLaws().Names(Deformation::finite);
   CHECK(std::set<std::string>(names.begin(), names.end()) == sampled);
}

TEST_CASE("Stresses are the derivatives of energies", "[laws]")
{
   for (const LawSample &sample : LawSamples())
   {
      CAPTURE(sample.name);
      const SampledLaw law(sample);
      const Tensor3<> F = SomeDeformation();
      CHECK(AreClose(EnergyDerivative(sample, F), StressOf(*law, F), 1e-12));
   }
}

TEST_CASE("Tangents are the derivatives of stresses", "[laws]")
{
   for (const LawSample &sample : LawSamples())
   {
      CAPTURE(sample.name);
      const SampledLaw law(sample);
      AnyPoint point;
      CheckDerivative([&](const Tensor3<> &F, Tensor3<> &P, Tangent3 *tangent)
                      { return law->GetStress(point.Get(), F, P, tangent); },
                      SomeDeformation());
   }
}

TEST_CASE("Stresses turn with the body", "[laws]")
{
   for (const LawSample &sample : LawSamples())
   {
      CAPTURE(sample.name);
      const SampledLaw law(sample);
      CHECK(law->IsObjective());
      const Tensor3<> F = SomeDeformation();
      const Tensor3<> Q = SomeRotation();
      CHECK(AreClose(Product(Q, StressOf(*law, F)),
                     StressOf(*law, Product(Q, F)), 1e-12));
   }
}

TEST_CASE("Small strains have the moduli that a law names", "[laws]")
{
   int isotropic = 0;
   for (const LawSample &sample : LawSamples())
   {
      CAPTURE(sample.name);
      const SampledLaw law(sample);
      if (law->AggregateModulus() == 0.0 || sample.name == "donnan" ||
          sample.name == "prlig" || sample.name == "trans_iso_mooney_rivlin")
      {
         // Fibers, what is under pressure undeformed, and what is anisotropic.
         continue;
      }
      AnyPoint point;
      DenseMatrix stiffness;
      law->GetStiffness(point.Get().trans, point.Get().ip, stiffness);
      const real_t H = law->AggregateModulus();
      const real_t mu = law->ShearModulus();
      isotropic += H > 0.0;
      for (int i = 0; i < 6; i++)
      {
         for (int j = 0; j < 6; j++)
         {
            CAPTURE(i, j);
            const real_t expected = i != j
                                       ? (i < 3 && j < 3 ? H - 2.0 * mu : 0.0)
                                    : i < 3 ? H
                                            : mu;
            CHECK(std::abs(stiffness(i, j) - expected) <= 1e-12 * H);
         }
      }
      const Tensor3<> rest = StressOf(*law, IdentityTensor());
      for (int k = 0; k < 9; k++)
      {
         CHECK(std::abs(rest[k / 3][k % 3]) <= 1e-14 * H);
      }
   }
   CHECK(isotropic == 5);
   // Those of E and nu.
   const SampledLaw neo_hookean("neo_hookean", {{"E", 0.5}, {"nu", 0.1}});
   const SampledLaw holmes_mow("holmes_mow",
                               {{"E", 0.5}, {"nu", 0.1}, {"beta", 0.5}});
   const IsotropicElastic linear(0.5, 0.1);
   for (const SampledLaw *law : {&neo_hookean, &holmes_mow})
   {
      CHECK((*law)->AggregateModulus() == Approx(linear.AggregateModulus()));
      CHECK((*law)->ShearModulus() == Approx(linear.ShearModulus()));
   }
}

TEST_CASE("Linear laws strain when they turn", "[laws]")
{
   const SampledLaw isotropic("isotropic", {{"E", 1.0}, {"nu", 0.3}});
   const SampledLaw fibers("transversely_isotropic", {{"E_r", 0.5},
                                                      {"E_theta", 5.0},
                                                      {"nu_rtheta", 0.05},
                                                      {"nu_rz", 0.3},
                                                      {"G_rtheta", 0.4}});
   for (const SampledLaw *law : {&isotropic, &fibers})
   {
      CHECK_FALSE((*law)->IsObjective());
      AnyPoint point;
      CheckDerivative([&](const Tensor3<> &F, Tensor3<> &P, Tangent3 *tangent)
                      { return (*law)->GetStress(point.Get(), F, P, tangent); },
                      SomeDeformation());
      DenseMatrix stiffness;
      (*law)->GetStiffness(point.Get().trans, point.Get().ip, stiffness);
      Tensor3<> stretched = IdentityTensor();
      stretched[1][1] += 0.01;
      stretched[0][2] += 0.02;
      const Tensor3<> P = StressOf(**law, stretched);
      for (int v = 0; v < 6; v++)
      {
         CHECK(P[voigt_pairs[v][0]][voigt_pairs[v][1]] ==
               Approx(0.01 * stiffness(v, 1) + 0.02 * stiffness(v, 5))
                  .margin(1e-14));
      }
   }
}

TEST_CASE("A mixture bears what its parts bear", "[laws]")
{
   const SampledLaw ground("holmes_mow",
                           {{"E", 1.0}, {"nu", 0.2}, {"beta", 0.35}});
   const SampledLaw fibers("fiber_nh", {{"mu", 2.0}});
   const SampledLaw linear("isotropic", {{"E", 1.0}, {"nu", 0.3}});
   const SampledLaw mixture("mixture", {}, {&*ground, &*fibers});
   const Tensor3<> F = SomeDeformation();
   CHECK(AreClose(StressOf(*ground, F) + StressOf(*fibers, F),
                  StressOf(*mixture, F), 1e-14));
   AnyPoint point;
   CheckDerivative([&](const Tensor3<> &G, Tensor3<> &P, Tangent3 *tangent)
                   { return mixture->GetStress(point.Get(), G, P, tangent); },
                   F);
   CHECK(mixture->AggregateModulus() == ground->AggregateModulus());
   CHECK(mixture->ShearModulus() == ground->ShearModulus());
   CHECK(mixture->IsObjective());
   CHECK_FALSE(SampledLaw("mixture", {}, {&*ground, &*linear})->IsObjective());
   CHECK_THROWS_WITH(SampledLaw("mixture", {}, {&*fibers}),
                     Catch::Contains("add a ground matrix"));
}

TEST_CASE("Laws refuse what they can't be", "[laws]")
{
   const CartesianFrame frame(Point3{{1.0, 0.0, 0.0}});
   CHECK_THROWS_WITH(NeoHookean(0.0, 0.3),
                     "Young's modulus is 0; it must be positive");
   CHECK_THROWS_WITH(NeoHookean(1.0, 0.5),
                     "Poisson's ratio is 0.5; it must be between -1 and 0.5");
   CHECK_THROWS_WITH(HolmesMow(1.0, 0.3, -1.0),
                     "the exponent beta is -1; it must be positive");
   CHECK_THROWS_WITH(MooneyRivlin(0.0, 0.0, 1.0), Catch::Contains("c1 and c2"));
   CHECK_THROWS_WITH(PorousNeoHookean(1.0, 1.0),
                     Catch::Contains("solid fraction is 1"));
   CHECK_THROWS_WITH(
      FiberExpPow(0.0, 1.5, 1.0, 0.0, 1.0, frame),
      "the exponent beta of the fibers is 1.5; it must be at least 2");
   CHECK_THROWS_WITH(FiberPowLinear(1.0, 1.0, 2.0, frame),
                     Catch::Contains("it must be above 1"));
   CHECK_THROWS_AS(FiberNh(std::nan(""), frame), Error);
}

TEST_CASE("Ligaments draw in by Poisson's ratio of their fibers", "[laws]")
{
   const real_t c1 = 3.0;
   const real_t mu = 0.4;
   const real_t v0 = 1.2;
   const real_t k = 0.7;
   const CartesianFrame frame(Point3{{0.0, 0.0, 1.0}});
   const Prlig law({c1, 10.0, mu, v0, -2.0, k}, FiberDirection(frame));
   AnyPoint point;
   DenseMatrix stiffness;
   law.GetStiffness(point.Get().trans, point.Get().ip, stiffness);
   CHECK(stiffness(0, 0) == Approx(4.0 * k + 2.0 * mu));
   CHECK(stiffness(0, 1) == Approx(4.0 * k));
   CHECK(stiffness(0, 2) == Approx(8.0 * k * v0));
   CHECK(stiffness(2, 2) == Approx(16.0 * k * v0 * v0 + 2.0 * mu + c1));
   CHECK(stiffness(3, 3) == Approx(mu));
   CHECK(stiffness(4, 4) == Approx(mu));
   CHECK(law.AggregateModulus() == Approx(stiffness(0, 0)));
   CHECK(law.ShearModulus() == mu);

   // Areas that follow the stretch cost no volume: only the matrix and the
   // fibers have stress.
   const real_t m = -2.0;
   const real_t stretch = 1.1;
   const real_t narrow =
      std::pow(stretch, m - v0) * std::exp(m * (1.0 - stretch));
   const Tensor3<> F{
      {{narrow, 0.0, 0.0}, {0.0, narrow, 0.0}, {0.0, 0.0, stretch}}};
   const Tensor3<> P = StressOf(law, F);
   CHECK(P[0][0] == Approx(mu * (narrow - 1.0 / narrow)));
   CHECK(P[2][2] == Approx(mu * (stretch - 1.0 / stretch) +
                           c1 * (stretch - 1.0) *
                              std::exp(10.0 * std::pow(stretch - 1.0, 2))));
}
