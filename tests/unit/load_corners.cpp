// ranks: 1 2
//
// Where loads have a corner the step after it starts from rest; elsewhere it is
// guessed from the rates of the one before.

#include "support/pressed_box.hpp"
#include "synovia/general/reduce.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

TEST_CASE("Nothing is guessed across a corner of a load")
{
   PressedBox box(MPI_COMM_WORLD, PressedBoxOptions());
   TimeOptions options;
   options.end = PressedBox::end;
   options.step = 10.0;
   TimeStepper stepper(box.Problem(), options);
   // Pressed up to here, lifted from here on.
   const real_t corner = 0.5 * PressedBox::end;
   int corners = 0;
   while (stepper.Time() < PressedBox::end - 1.5 * options.step)
   {
      const StepReport report = stepper.Step();
      CAPTURE(report.time, report.reason);
      REQUIRE(report.converged);
      const Vector &rate = box.Problem().Operator().AcceptedRate();
      const real_t fastest = MaxOverRanks(rate.Normlinf(), MPI_COMM_WORLD);
      if (std::abs(stepper.Time() - corner) < 1e-9)
      {
         CHECK(fastest == 0.0);
         corners++;
      }
      else
      {
         CHECK(fastest > 1e-6);
      }
   }
   CHECK(corners == 1);
}
