// ranks: 1
//
// Laws of fibers: slack, taut, and in between.

#include "support/law_samples.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

TEST_CASE("Fibers resist no compression", "[laws]")
{
   const CartesianFrame along_x(Point3{{1.0, 0.0, 0.0}});
   const Tensor3<> shorter{{{0.9, 0.0, 0.0}, {0.0, 1.1, 0.0}, {0.0, 0.0, 1.1}}};
   const Tensor3<> longer{{{1.2, 0.0, 0.0}, {0.0, 0.9, 0.0}, {0.0, 0.0, 0.9}}};
   int fibers = 0;
   for (const LawSample &sample : LawSamples())
   {
      if (sample.name.rfind("fiber_", 0) != 0)
      {
         continue;
      }
      fibers++;
      CAPTURE(sample.name);
      const auto law = SolidLaws().Make(
         sample.name, {sample.values, along_x, sample_solid_fraction, {}});
      Tangent3 tangent;
      const Tensor3<> P = StressOf(*law, shorter, &tangent);
      for (int k = 0; k < 9; k++)
      {
         CHECK(P[k / 3][k % 3] == 0.0);
         CHECK(tangent[k][k] == 0.0);
      }
      CHECK(StressOf(*law, longer)[0][0] > 0.0);
   }
   CHECK(fibers == 7);
   // s = mu (I_n - 1)/J N
   const FiberNh fiber(2.0, along_x);
   CHECK(PushedForward(StressOf(fiber, longer), longer)[0][0] ==
         Approx(2.0 * (1.44 - 1.0) / (1.2 * 0.81) * 1.44));
}

TEST_CASE("Fibers have the modulus that is said of them", "[laws]")
{
   const CartesianFrame along_x(Point3{{1.0, 0.0, 0.0}});
   const auto modulus = [](const SolidLaw &fibers, real_t stretch)
   {
      Tensor3<> F = IdentityTensor();
      F[0][0] = stretch;
      Tangent3 tangent;
      StressOf(fibers, F, &tangent);
      return tangent[0][0];
   };
   const real_t taut = 1.0 + 1e-7;
   CHECK(modulus(FiberNh(2.0, along_x), taut) == Approx(4.0).epsilon(1e-6));
   CHECK(modulus(FiberPow(3.0, 2.0, along_x), taut) ==
         Approx(24.0).epsilon(1e-6));
   CHECK(modulus(FiberExpPow(1.0, 2.0, 3.0, 0.0, 1.0, along_x), taut) ==
         Approx(12.0).epsilon(1e-6));
   CHECK(modulus(FiberNaturalNh(5.0, 1.0, along_x), taut) ==
         Approx(5.0).epsilon(1e-6));
   // Its toe meets the straight part with the same stress and stiffness.
   const FiberPowLinear toe(10.0, 1.1, 3.0, along_x);
   CHECK(modulus(toe, 1.1 - 1e-9) == Approx(modulus(toe, 1.1 + 1e-9)));
   Tensor3<> before = IdentityTensor();
   Tensor3<> beyond = IdentityTensor();
   before[0][0] = 1.1 - 1e-9;
   beyond[0][0] = 1.1 + 1e-9;
   CHECK(StressOf(toe, before)[0][0] ==
         Approx(StressOf(toe, beyond)[0][0]).epsilon(1e-6));
}

TEST_CASE("Undeformed fibers count as taut", "[laws]")
{
   AnyPoint point;
   int fibers = 0;
   for (const LawSample &sample : LawSamples())
   {
      const SampledLaw law(sample);
      if (law->AggregateModulus() > 0.0)
      {
         continue;
      }
      CAPTURE(sample.name);
      fibers++;
      // Within round-off, whichever side of 1 it is on.
      for (const real_t round_off : {-1e-15, 0.0, 1e-15})
      {
         const Tensor3<> F = (1.0 + round_off) * IdentityTensor();
         Tangent3 tangent;
         const Tensor3<> P = StressOf(*law, F, &tangent);
         for (int k = 0; k < 9; k++)
         {
            CHECK(std::abs(P[k / 3][k % 3]) < 1e-10);
            CHECK(std::isfinite(tangent[k][k]));
         }
      }
   }
   CHECK(fibers == 7);
   const CartesianFrame along_x(Point3{{1.0, 0.0, 0.0}});
   DenseMatrix stiffness;
   FiberNh(2.0, along_x)
      .GetStiffness(point.Get().trans, point.Get().ip, stiffness);
   CHECK(stiffness(0, 0) == Approx(4.0));
   CHECK(stiffness(1, 1) < 1e-10);
   FiberNaturalNh(2.0, 1.05, along_x)
      .GetStiffness(point.Get().trans, point.Get().ip, stiffness);
   CHECK(stiffness(0, 0) == 0.0);
}
