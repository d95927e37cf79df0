// ranks: 1 2 3
//
// A body that nothing holds is an error in the step in which it shows: neither
// supports, nor springs, nor contact that bears a traction.

#include "support/boxes.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

using namespace mfem;
using namespace synovia;

namespace
{
enum class Below
{
   fixed,
   guided,
   nothing,
   springs
};

/// A box on a layer, which it is pressed onto by a displacement or a force.
struct Press
{
   Below below = Below::fixed;
   LoadCurve displacement = Ramp(2.0, -0.01);
   bool by_force = false;
   LoadCurve force = 0.0;
};

struct Outcome
{
   int steps = 0;
   std::string reason;
   bool touched = false;
};

Outcome Run(const Press &press)
{
   BoxOptions lower;
   lower.nx = lower.ny = 3;
   lower.nz = 1;
   BoxOptions upper(lower);
   upper.nx = upper.ny = 2;
   NamedMesh bodies = MakeStack(lower, upper);
   const IsotropicElastic solid(0.7, 0.2);
   const ConstantPermeability permeability(4e-3);
   SpaceOptions space;
   space.order = 1;
   BiphasicProblem problem(bodies, space);
   problem.SetMaterial("lower", solid, permeability);
   problem.SetMaterial("upper", solid, permeability);
   problem.PrescribePressure("lower_x1", 0.0);
   problem.PrescribeDisplacement("upper_z1", 0, 0.0);
   problem.PrescribeDisplacement("upper_z1", 1, 0.0);
   if (press.by_force)
   {
      problem.DriveByForce({"upper_z1"}, Vector({0.0, 0.0, -1.0}), press.force);
   }
   else
   {
      problem.PrescribeDisplacement("upper_z1", 2, press.displacement);
   }
   if (press.below == Below::fixed)
   {
      problem.FixDisplacement("lower_z0");
   }
   if (press.below == Below::guided)
   {
      problem.PrescribeDisplacement("lower_x0", 0, 0.0);
      problem.PrescribeDisplacement("lower_y0", 1, 0.0);
   }
   if (press.below == Below::springs)
   {
      // However soft they are.
      problem.AddSprings({"lower_z0"}, 1e-3, Vector());
   }
   problem.AddContact("upper_z0", "lower_z1", ContactOptions(), "pair");
   NonlinearOptions nonlinear;
   nonlinear.linear.method = LinearMethod::direct;
   problem.SetNonlinearOptions(nonlinear);
   TimeOptions times;
   times.step = 1.0;
   times.end = 4.0;
   times.cut_back = false;
   TimeStepper stepper(problem, times);
   Outcome outcome;
   while (!stepper.Done() && outcome.reason.empty())
   {
      outcome.reason = stepper.Step().reason;
   }
   outcome.steps = stepper.Steps();
   outcome.touched = HasTouched(*problem.Operator().Pairs().front());
   return outcome;
}
} // namespace

TEST_CASE("What is held is no error")
{
   Press press;
   SECTION("by supports") {}
   SECTION("by soft springs")
   {
      press.below = Below::springs;
   }
   SECTION("by contact with traction")
   {
      press.by_force = true;
      press.force = Ramp(2.0, 0.01);
   }
   const Outcome outcome = Run(press);
   CHECK(outcome.reason == "");
   CHECK(outcome.steps == 4);
   CHECK(outcome.touched);
}

TEST_CASE("A layer that nothing supports is an error in the first step")
{
   Press press;
   SECTION("but that is guided")
   {
      press.below = Below::guided;
      const Outcome outcome = Run(press);
      CHECK(outcome.steps == 0);
      CHECK_FALSE(outcome.touched);
      CHECK_THAT(outcome.reason,
                 Catch::Contains("nothing holds \"lower\", free to move along "
                                 "z; prescribe a displacement there"));
   }
   SECTION("in no way")
   {
      press.below = Below::nothing;
      const Outcome outcome = Run(press);
      CHECK(outcome.steps == 0);
      for (const char *motion :
           {"nothing holds \"lower\", free to move along x", "move along z",
            "turn about z through (0.5, 0.5, 0.5)"})
      {
         CHECK_THAT(outcome.reason, Catch::Contains(motion));
      }
   }
}

TEST_CASE("A body that its force lets go is an error in that step")
{
   Press press;
   press.by_force = true;
   press.force = LoadCurve({0.0, 2.0, 4.0}, {0.0, 0.01, -0.01});
   const Outcome outcome = Run(press);
   CHECK(outcome.steps == 2);
   CHECK(outcome.touched);
   CHECK_THAT(outcome.reason,
              Catch::Contains("nothing holds \"upper\", free to move along z"));
}

TEST_CASE("A pair that is lifted has not touched")
{
   Press press;
   press.displacement = Ramp(2.0, 0.01);
   const Outcome outcome = Run(press);
   CHECK(outcome.reason == "");
   CHECK_FALSE(outcome.touched);
}
