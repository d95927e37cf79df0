// ranks: 1
//
// What the step control decides, without a problem to solve.

#include "synovia/time/step_control.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace mfem;
using namespace synovia;

namespace
{
StepLimits Adaptive()
{
   StepLimits limits;
   limits.first = 1.0;
   limits.shortest = 1e-4;
   limits.longest = 100.0;
   limits.adaptive = true;
   limits.tolerance = 1e-3;
   return limits;
}

StepAttempt MakeAttempt(real_t dt, real_t error, real_t newton = 2.0)
{
   StepAttempt step;
   step.dt = dt;
   step.error = error;
   step.newton = newton;
   return step;
}
} // namespace

TEST_CASE("A step that fails is halved down to the shortest one")
{
   StepLimits limits;
   limits.first = 1.0;
   limits.shortest = 0.2;
   StepControl control(limits);
   CHECK(control.Fail(1.0));
   CHECK(control.Length() == 0.5);
   CHECK(control.Fail(0.5));
   CHECK(control.Length() == 0.25);
   CHECK(control.Fail(0.25));
   CHECK(control.Length() == 0.2);
   CHECK_FALSE(control.Fail(0.2));
}

TEST_CASE("A step that must not be cut fails at once")
{
   StepLimits limits;
   limits.cut_back = false;
   StepControl control(limits);
   CHECK_FALSE(control.Fail(1.0));
   CHECK(control.Length() == 1.0);
}

TEST_CASE("Fixed steps grow back to their length, if they are easy")
{
   StepLimits limits;
   StepControl control(limits);
   CHECK(control.Fail(1.0));
   CHECK(control.Fail(0.5));
   control.Grow(MakeAttempt(0.25, 0.0, 100.0));
   CHECK(control.Length() == 0.25);
   control.Grow(MakeAttempt(0.25, 0.0));
   CHECK(control.Length() == 0.5);
   control.Grow(MakeAttempt(0.5, 0.0));
   CHECK(control.Length() == 1.0);
   control.Grow(MakeAttempt(1.0, 0.0));
   CHECK(control.Length() == 1.0);
}

TEST_CASE("Steps have the lengths that are planned, but for those that fail")
{
   StepControl control((StepLimits()));
   control.Plan(2.0);
   CHECK(control.Length() == 2.0);
   CHECK_FALSE(control.IsCut());
   control.Grow(MakeAttempt(2.0, 0.0));
   control.Plan(3.0);
   CHECK(control.Length() == 3.0);
   CHECK(control.Fail(3.0));
   CHECK(control.IsCut());
   CHECK(control.Length() == 1.5);
   control.Grow(MakeAttempt(1.5, 0.0, 100.0));
   control.Plan(4.0);
   CHECK(control.Length() == 1.5);
   control.Grow(MakeAttempt(1.5, 0.0));
   CHECK(control.Length() == 3.0);
   control.Grow(MakeAttempt(3.0, 0.0));
   CHECK(control.Length() == 4.0);
   CHECK_FALSE(control.IsCut());
   control.Plan(1.0);
   CHECK(control.Length() == 1.0);

   StepControl adaptive(Adaptive());
   adaptive.Plan(50.0);
   CHECK(adaptive.Length() == 1.0);
   CHECK_FALSE(adaptive.IsCut());
}

TEST_CASE("The length settles where the error is near its tolerance")
{
   StepControl control(Adaptive());
   const auto error = [](real_t dt) { return 0.025 * dt * dt; };
   const real_t ideal = std::sqrt(1e-3 / 0.025);
   int attempts = 0;
   real_t dt = 0.0;
   for (int step = 0; step < 20; step++)
   {
      do
      {
         dt = control.Length();
         attempts++;
         REQUIRE(attempts < 40);
      } while (control.Judge(MakeAttempt(dt, error(dt))) ==
               StepControl::Verdict::repeat);
      CHECK(error(dt) <= 1e-3);
      control.Grow(MakeAttempt(dt, error(dt)));
   }
   CHECK(dt <= ideal);
   CHECK(dt > 0.6 * ideal);
   CHECK(attempts <= 22);
}

TEST_CASE("A stiff start, whose error falls slowly, takes few attempts")
{
   StepControl control(Adaptive());
   const auto error = [](real_t dt) { return 0.05 * std::sqrt(dt); };
   int attempts = 0;
   real_t dt = 0.0;
   do
   {
      dt = control.Length();
      attempts++;
      REQUIRE(attempts < 20);
   } while (control.Judge(MakeAttempt(dt, error(dt))) ==
            StepControl::Verdict::repeat);
   // 0.05 sqrt(dt) = 1e-3
   CHECK(dt <= 4e-4);
   CHECK(attempts <= 5);
}

TEST_CASE("An error that a shorter step does not mend is accepted as a jump")
{
   StepControl control(Adaptive());
   CHECK(control.Judge(MakeAttempt(1.0, 0.02)) == StepControl::Verdict::repeat);
   const real_t dt = control.Length();
   CHECK(dt < 1.0);
   CHECK(control.Judge(MakeAttempt(dt, 0.02)) ==
         StepControl::Verdict::accept_jump);
   control.Grow(MakeAttempt(dt, 0.02));
   CHECK(control.Length() >= 0.1 * dt);
}

TEST_CASE("The shortest step is accepted with any error")
{
   StepControl control(Adaptive());
   CHECK(control.Judge(MakeAttempt(1e-4, 1.0)) == StepControl::Verdict::accept);
}

TEST_CASE("A step that was short to end on time does not shorten the next one")
{
   StepControl control(Adaptive());
   const real_t length = control.Length();
   control.Grow(MakeAttempt(1e-3 * length, 1e-10));
   CHECK(control.Length() >= length);
   SECTION("unless its error says that it must")
   {
      control.Grow(MakeAttempt(1e-3 * length, 1e-3));
      CHECK(control.Length() < 0.01 * length);
   }
}
