// ranks: 1
//
// When Newton's method of nonlinear bodies takes a new tangent or searches
// contact anew, and how accurately it solves.

#include "synovia/physics/forcing_term.hpp"
#include "synovia/physics/search_rule.hpp"
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
   // 0.5 would be left, but it fell by two only.
   CHECK(renewal.IsDue(0.5));
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
   ForcingTerm forcing(1e-2, 0.9, 1e-7);
   CHECK(forcing.Next(1e6) == 1e-2);
   CHECK(forcing.Next(1e5) == Approx(9e-3));
   CHECK(forcing.Next(1e2) == Approx(9e-7));
   CHECK(forcing.Next(90.0) == 1e-2);
}

TEST_CASE("The first linear system is solved as accurately as a good guess is "
          "worth")
{
   ForcingTerm forcing(1e-2, 0.9, 1e-7);
   CHECK(forcing.Next(1e3) == Approx(1e-4));
}

TEST_CASE("Contact is searched anew while each search upsets less")
{
   NewtonTuning tuning;
   tuning.max_searches = 3;
   tuning.search_reduction = 0.5;
   SearchRule rule(tuning);
   rule.AddResidual(1e6);
   rule.AddResidual(0.5);
   CHECK(rule.Allows());
   rule.Restart();
   rule.AddResidual(1e4);
   rule.AddResidual(0.5);
   CHECK(rule.Allows());
   rule.Restart();
   // The search before it cost 1e4.
   rule.AddResidual(0.6e4);
   rule.AddResidual(0.5);
   CHECK_FALSE(rule.Allows());
}

TEST_CASE("Contact is searched anew no more often than the tuning says")
{
   NewtonTuning tuning;
   tuning.max_searches = 2;
   SearchRule rule(tuning);
   rule.AddResidual(1e6);
   rule.Restart();
   rule.AddResidual(1e3);
   CHECK(rule.Allows());
   rule.Restart();
   rule.AddResidual(1.0);
   CHECK_FALSE(rule.Allows());
}

TEST_CASE("Contact is searched anew once the residual is a small part of what "
          "the last search made")
{
   NewtonTuning tuning;
   tuning.search_accuracy = 1e-3;
   SearchRule rule(tuning);
   rule.AddResidual(1e6);
   rule.AddResidual(2e3);
   CHECK_FALSE(rule.IsNear(2e3));
   CHECK(rule.IsNear(1e3));
   rule.Restart();
   rule.AddResidual(1e4);
   CHECK_FALSE(rule.IsNear(1e3));
   CHECK(rule.IsNear(10.0));
}

TEST_CASE("Without searches contact is searched only with the step")
{
   NewtonTuning tuning;
   tuning.max_searches = 0;
   SearchRule rule(tuning);
   rule.AddResidual(1e6);
   CHECK_FALSE(rule.Allows());
}

TEST_CASE("The first changes of the active set are searched for at once")
{
   NewtonTuning tuning;
   tuning.max_early_searches = 2;
   SearchRule rule(tuning);
   CHECK(rule.AllowsEarly(1e6));
   CHECK(rule.AllowsEarly(1e5));
   CHECK_FALSE(rule.AllowsEarly(1e4));
   SearchRule other(tuning);
   other.Restart();
   CHECK_FALSE(other.AllowsEarly(1e5));
}

TEST_CASE("Searches that take the active set to and fro come to an end")
{
   SearchRule rule{NewtonTuning()};
   CHECK(rule.AllowsEarly(1e6));
   CHECK(rule.AllowsEarly(1e4));
   CHECK_FALSE(rule.AllowsEarly(2e4));
   CHECK_FALSE(rule.AllowsEarly(1e4));
   CHECK(rule.AllowsEarly(1e3));
}
