// ranks: 1
//
// When Newton's method of nonlinear bodies takes a new tangent, and how
// accurately it solves.

#include "synovia/physics/forcing_term.hpp"
#include "synovia/physics/tangent_renewal.hpp"

#include <catch2/catch.hpp>

using namespace mfem;
using namespace synovia;

TEST_CASE("The tangent is kept where one more iteration with it will do")
{
   NewtonTuning tuning;
   tuning.kept_tangent = 2.0;
   TangentRenewal renewal(tuning);
   CHECK(renewal.IsDue(1e6));
   // Falls by 10: 1e4 would be left.
   CHECK(renewal.IsDue(1e5));
   // Falls by 1000: 0.1 would be left.
   CHECK_FALSE(renewal.IsDue(1e2));
   // It fell by 20 only: 0.25 would be left.
   CHECK_FALSE(renewal.IsDue(5.0));
   // It grew.
   CHECK(renewal.IsDue(50.0));
   CHECK_FALSE(renewal.IsDue(1.0));
   renewal.Restart();
   CHECK(renewal.IsDue(1.0));
}

TEST_CASE("Without a tolerance for it no tangent is kept")
{
   NewtonTuning tuning;
   tuning.kept_tangent = 0.0;
   TangentRenewal renewal(tuning);
   CHECK(renewal.IsDue(1e6));
   CHECK(renewal.IsDue(1e-6));
   CHECK(renewal.IsDue(1e-18));
}

TEST_CASE("Linear systems are solved as accurately as the residual falls")
{
   ForcingTerm forcing(1e-2, 0.9);
   CHECK(forcing.Next(1e6) == 1e-2);
   CHECK(forcing.Next(1e5) == Approx(9e-3));
   CHECK(forcing.Next(1e2) == Approx(9e-7));
   // None is less accurate than the first.
   CHECK(forcing.Next(90.0) == 1e-2);
}
