// ranks: 1 2 3
//
// A factorization that fails is a step that fails, whatever preconditioner it
// belongs to.

#include "support/pressed_box.hpp"

#include <catch2/catch.hpp>

using namespace mfem;
using namespace synovia;

namespace
{
TimeOptions Steps()
{
   TimeOptions times;
   times.end = PressedBox::end;
   times.step = 10.0;
   times.min_step = 2.5;
   return times;
}

PressedBoxOptions Limited(LinearMethod method, int memory_limit)
{
   PressedBoxOptions options;
   // The filter solves for few unknowns.
   options.order = method == LinearMethod::direct ? 2 : 3;
   options.method = method;
   options.direct.memory_limit = memory_limit;
   return options;
}
} // namespace

TEST_CASE("A factorization without enough memory fails the step")
{
   const LinearMethod method =
      GENERATE(LinearMethod::direct, LinearMethod::block_amg);
   CAPTURE(method);
   PressedBox box(MPI_COMM_WORLD, Limited(method, 1));
   TimeStepper stepper(box.Problem(), Steps());
   const StepReport failed = stepper.Step();
   CHECK_FALSE(failed.converged);
   CHECK(failed.failures == 3);
   CHECK(failed.dt == 2.5);
   CHECK_THAT(
      failed.reason,
      Catch::StartsWith("MUMPS could not factorize the matrix (") &&
         Catch::Contains(" MB more than direct_memory_limit (1 MB) allows") &&
         Catch::EndsWith(
            " (tried 3 times; a step is not cut below min_step = 2.5)"));
   CHECK(stepper.Time() == 0.0);
   CHECK(stepper.State().Norml2() == 0.0);
   // It fails in the same way again.
   CHECK_FALSE(stepper.Step().converged);
}

TEST_CASE("A limit that suffices changes nothing")
{
   PressedBox free_box(MPI_COMM_WORLD, Limited(LinearMethod::direct, 0));
   TimeStepper unlimited(free_box.Problem(), Steps());
   PressedBox roomy_box(MPI_COMM_WORLD, Limited(LinearMethod::direct, 1000));
   TimeStepper limited(roomy_box.Problem(), Steps());
   CHECK(unlimited.Step().converged);
   CHECK(limited.Step().converged);
   Vector difference(limited.State());
   difference -= unlimited.State();
   REQUIRE(unlimited.State().Norml2() > 0.0);
   CHECK(difference.Norml2() < 1e-8 * unlimited.State().Norml2());
}
