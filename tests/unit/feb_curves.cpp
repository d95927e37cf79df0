// Load controllers of FEBio between and beyond their points, and the steps of
// its automatic time stepper.

#include "synovia/feb/feb_curves.hpp"
#include "support/feb_text.hpp"
#include "synovia/feb/feb_import.hpp"

#include <catch2/catch.hpp>

using namespace mfem;
using namespace synovia;

namespace
{
using Between = FebCurve::Between;
using Beyond = FebCurve::Beyond;

const std::vector<real_t> times{0.0, 1.0, 2.0, 4.0};
const std::vector<real_t> values{0.0, 1.0, 4.0, 16.0};
} // namespace

TEST_CASE("Between points a controller is linear, a step or smooth")
{
   const FebCurve linear(times, values, Between::linear, Beyond::constant);
   CHECK(linear(0.5) == Approx(0.5));
   CHECK(linear(3.0) == Approx(10.0));
   // The value of the next point.
   const FebCurve step(times, values, Between::step, Beyond::constant);
   CHECK(step(0.0) == 0.0);
   CHECK(step(1e-9) == 1.0);
   CHECK(step(1.0) == 1.0);
   CHECK(step(2.5) == 16.0);
   // The points are on a parabola.
   const FebCurve smooth(times, values, Between::smooth, Beyond::constant);
   for (const real_t t : {0.3, 1.0, 1.5, 3.7})
   {
      CHECK(smooth(t) == Approx(t * t));
   }
   const FebCurve two({0.0, 2.0}, {0.0, 4.0}, Between::smooth,
                      Beyond::constant);
   CHECK(two(0.5) == Approx(1.0));
}

TEST_CASE("Beyond its points a controller is constant, goes on, or repeats")
{
   const FebCurve constant(times, values, Between::linear, Beyond::constant);
   CHECK(constant(9.0) == 16.0);
   CHECK(constant(-1.0) == 0.0);
   const FebCurve on(times, values, Between::linear, Beyond::extrapolate);
   CHECK(on(5.0) == Approx(22.0));
   CHECK(on(-1.0) == Approx(-1.0));
   const FebCurve again(times, values, Between::linear, Beyond::repeat);
   CHECK(again(4.5) == Approx(0.5));
   CHECK(again(9.0) == Approx(1.0));
}

TEST_CASE("A case's curve is the controller at the ends of steps")
{
   const std::vector<real_t> ends{0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0};
   for (const Between between :
        {Between::linear, Between::step, Between::smooth})
   {
      for (const Beyond beyond :
           {Beyond::constant, Beyond::extrapolate, Beyond::repeat})
      {
         const FebCurve curve(times, values, between, beyond);
         const LoadCurve load = curve.ForSteps(ends, 3.0);
         for (const real_t t : ends)
         {
            CHECK(load(t) == Approx(3.0 * curve(t)).margin(1e-12));
         }
      }
   }
   // Points that are ends of steps stay as they are.
   const FebCurve linear(times, values, Between::linear, Beyond::constant);
   CHECK(linear.ForSteps(ends, 1.0).Corners() == times);
   // A load that steps on is constant.
   const FebCurve on({0.0, 1.0}, {0.0, 2.0}, Between::step, Beyond::constant);
   CHECK(on.ForSteps(ends, 1.0)(0.0) == 2.0);
}

TEST_CASE("Automatic steps grow to the largest length and end on must points")
{
   const std::string text = Replaced(
      Replaced(FebColumn(), "<step_size>0.5</step_size>",
               "<step_size>0.5</step_size><time_stepper type=\"default\">"
               "<dtmin>0.01</dtmin><dtmax lc=\"2\">0</dtmax></time_stepper>"),
      "<load_controller id=\"1\"",
      "<load_controller id=\"2\" type=\"loadcurve\"><interpolate>STEP"
      "</interpolate><points><pt>0,0</pt><pt>1,1</pt><pt>5,2</pt></points>"
      "</load_controller><load_controller id=\"1\"");
   const FebImport import = ImportFeb(text, "model.feb");
   CHECK_FALSE(import.report.IsStopped());
   CHECK(import.report.Text(FebReport::Fate::approximated) != "");
   // 0.5; the next would be 0.5 + 0.2 (1 - 0.5) = 0.6, but 1 comes first; from
   // there 0.6 + 0.2 (1 - 0.6) = 0.68, then a fifth of the way to 2 each time.
   const std::vector<real_t> expected{0.5, 1.0, 1.68, 2.624, 3.7792};
   REQUIRE(import.setup.time.stops.size() == expected.size());
   for (size_t i = 0; i < expected.size(); i++)
   {
      CHECK(import.setup.time.stops[i] == Approx(expected[i]));
   }
   CHECK(import.setup.time.end == 5.0);
   CHECK(import.setup.time.step == Approx(5.0 - 3.7792));
}
