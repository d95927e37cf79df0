// ranks: 1 2 3
//
// A step that fails leaves no trace: a run that was cut back equals one that
// took the same steps at once.

#include "support/pressed_box.hpp"
#include "synovia/io/state_snapshot.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace mfem;
using namespace synovia;

namespace
{
/// No force at all, but not a number when it is told to fail.
class FailingForce : public VectorCoefficient
{
public:
   FailingForce() : VectorCoefficient(3) {}

   using VectorCoefficient::Eval;
   void Eval(Vector &force, ElementTransformation &,
             const IntegrationPoint &) override
   {
      force.SetSize(3);
      force = fails ? std::numeric_limits<real_t>::quiet_NaN() : 0.0;
   }
   void SetTime(real_t t) override
   {
      VectorCoefficient::SetTime(t);
      fails = failures_left > 0;
      failures_left -= fails ? 1 : 0;
   }
   /// The next so many solves.
   void Fail(int times) { failures_left = times; }

private:
   int failures_left = 0;
   bool fails = false;
};

struct Row
{
   real_t time;
   int failures;
   Vector state;
   Vector traction;
   Vector status;
   Point3 force;
};

struct Run
{
   TimeOptions times;
   int max_newton = 30;
   /// The step, counted from 0, in which this many solves fail.
   int failing_step = -1;
   int failures = 1;
};

TimeOptions Steps(real_t step)
{
   TimeOptions options;
   options.end = PressedBox::end;
   options.step = step;
   return options;
}

Row Record(PressedBox &box, TimeStepper &stepper, int failures)
{
   Row row;
   row.time = stepper.Time();
   row.failures = failures;
   row.state = stepper.State();
   row.traction = box.Pair().State().traction;
   row.status = box.Pair().State().Touching();
   row.force = box.Force();
   return row;
}

std::vector<Row> Solve(const Run &run)
{
   FailingForce force;
   PressedBoxOptions options;
   options.body_force = &force;
   options.max_newton = run.max_newton;
   // A factorization of a step that failed serves steps of other lengths, too,
   // which makes a difference within the tolerances.
   options.tuning.factorization.like_step = 1.0;
   PressedBox box(MPI_COMM_WORLD, options);
   TimeStepper stepper(box.Problem(), run.times);
   std::vector<Row> rows;
   while (!stepper.Done())
   {
      if (stepper.Steps() == run.failing_step)
      {
         force.Fail(run.failures);
      }
      const StepReport report = stepper.Step();
      CAPTURE(report.reason, report.time);
      REQUIRE(report.converged);
      CHECK(std::isfinite(stepper.State().Norml2()));
      rows.push_back(Record(box, stepper, report.failures));
   }
   return rows;
}

int TotalFailures(const std::vector<Row> &rows)
{
   int sum = 0;
   for (const Row &row : rows)
   {
      sum += row.failures;
   }
   return sum;
}

void CheckSame(const Vector &a, const Vector &b)
{
   REQUIRE(a.Size() == b.Size());
   Vector difference(a);
   difference -= b;
   // MUMPS adds up what other ranks send in the order in which it comes.
   const real_t round_off =
      Mpi::WorldSize() == 1 ? 0.0 : 1e-9 * (1e-3 + b.Normlinf());
   CHECK((a.Size() == 0 || difference.Normlinf() <= round_off));
}

void CheckSame(const std::vector<Row> &some, const std::vector<Row> &others)
{
   REQUIRE(some.size() == others.size());
   for (std::size_t i = 0; i < some.size(); i++)
   {
      CAPTURE(i, some[i].time, some[i].failures);
      CHECK(some[i].time == others[i].time);
      CheckSame(some[i].state, others[i].state);
      CheckSame(some[i].traction, others[i].traction);
      CheckSame(some[i].status, others[i].status);
   }
}

std::vector<real_t> Times(const std::vector<Row> &rows)
{
   std::vector<real_t> times;
   for (const Row &row : rows)
   {
      times.push_back(row.time);
   }
   return times;
}
} // namespace

TEST_CASE("A run with failed steps equals one without")
{
   Run failing;
   failing.times = Steps(10.0);
   SECTION("in the first step, where nothing is known of the contact")
   {
      failing.failing_step = 0;
   }
   SECTION("in a later one")
   {
      failing.failing_step = 2;
   }
   SECTION("several times")
   {
      failing.failing_step = 5;
      failing.failures = 3;
   }
   SECTION("in the second stage of a step")
   {
      failing.times.scheme = TimeScheme::sdirk33;
      failing.failing_step = 3;
   }
   SECTION("because the active set does not settle")
   {
      failing.max_newton = 4;
   }
   const std::vector<Row> failed = Solve(failing);
   CHECK(TotalFailures(failed) >= 1);

   Run direct;
   direct.times = failing.times;
   direct.times.stops = Times(failed);
   direct.max_newton = failing.max_newton;
   const std::vector<Row> at_once = Solve(direct);
   CHECK(TotalFailures(at_once) == 0);
   CheckSame(failed, at_once);
   // Contact changes in the run, and steps get back to their times.
   const std::vector<real_t> times = Times(failed);
   for (real_t t = 10.0; t <= PressedBox::end; t += 10.0)
   {
      CHECK(std::find(times.begin(), times.end(), t) != times.end());
   }
   CHECK(std::abs(failed.back().force[2]) > 1e-4);
}

TEST_CASE("A failed step that is not cut leaves everything as it was")
{
   Run whole;
   whole.times = Steps(10.0);
   const std::vector<Row> expected = Solve(whole);

   FailingForce force;
   PressedBoxOptions options;
   options.body_force = &force;
   PressedBox box(MPI_COMM_WORLD, options);
   TimeOptions times = Steps(10.0);
   times.cut_back = false;
   TimeStepper stepper(box.Problem(), times);
   std::vector<Row> rows;
   while (!stepper.Done())
   {
      force.Fail(1);
      const StepReport failed = stepper.Step();
      CHECK_FALSE(failed.converged);
      CHECK(failed.reason == "the residual is not a finite number");
      CHECK(failed.failures == 1);
      CHECK(stepper.Steps() == static_cast<int>(rows.size()));
      if (!rows.empty())
      {
         CHECK(failed.time == rows.back().time);
         CheckSame(stepper.State(), rows.back().state);
         CheckSame(box.Pair().State().traction, rows.back().traction);
         CheckSame(box.Pair().State().Touching(), rows.back().status);
         CHECK(box.Force()[2] == rows.back().force[2]);
      }
      REQUIRE(stepper.Step().converged);
      rows.push_back(Record(box, stepper, 0));
   }
   CheckSame(rows, expected);
}

TEST_CASE("A step that can't be made says why, and where it ended")
{
   SECTION("at the shortest step")
   {
      FailingForce force;
      PressedBoxOptions options;
      options.body_force = &force;
      PressedBox box(MPI_COMM_WORLD, options);
      TimeOptions times = Steps(8.0);
      times.min_step = 1.0;
      TimeStepper stepper(box.Problem(), times);
      REQUIRE(stepper.Step().converged);
      force.Fail(1000);
      const StepReport report = stepper.Step();
      CHECK_FALSE(report.converged);
      CHECK(report.failures == 4);
      CHECK(report.dt == 1.0);
      CHECK(report.time == 8.0);
      CHECK(stepper.Time() == 8.0);
      CHECK(report.reason ==
            "the residual is not a finite number (tried 4 times; a step is not "
            "cut below min_step = 1)");
   }
   SECTION("with the pair that did not settle")
   {
      PressedBoxOptions options;
      options.max_newton = 1;
      PressedBox box(MPI_COMM_WORLD, options);
      TimeOptions times = Steps(10.0);
      times.cut_back = false;
      TimeStepper stepper(box.Problem(), times);
      const StepReport report = stepper.Step();
      CHECK_FALSE(report.converged);
      CHECK_THAT(report.reason, Catch::Contains("upper_z0-lower_z1"));
   }
}

TEST_CASE("Steps grow from each corner of a load to the longest, and get back "
          "to their times where one failed")
{
   // The box is pressed up to 40, and lifted from then on.
   Run run;
   run.times = Steps(2.0);
   run.times.growth = 2.0;
   run.times.max_step = 10.0;
   const std::vector<real_t> times = Times(Solve(run));
   REQUIRE(times.size() >= 8);
   const std::vector<real_t> first(times.begin(), times.begin() + 8);
   CHECK(first ==
         std::vector<real_t>{2.0, 6.0, 14.0, 24.0, 34.0, 40.0, 42.0, 46.0});

   run.failing_step = 2; // from 6 to 14
   const std::vector<real_t> cut = Times(Solve(run));
   REQUIRE(cut.size() == times.size() + 1);
   CHECK(cut[2] == 10.0);
   CHECK(std::vector<real_t>(cut.begin() + 3, cut.end()) ==
         std::vector<real_t>(times.begin() + 2, times.end()));
}

TEST_CASE("Growing steps go on from a snapshot, between cut ones too")
{
   TimeOptions times = Steps(2.0);
   times.growth = 2.0;
   FailingForce force;
   PressedBoxOptions options;
   options.body_force = &force;
   PressedBox box(MPI_COMM_WORLD, options);
   TimeStepper stepper(box.Problem(), times);
   PressedBox other(MPI_COMM_WORLD, PressedBoxOptions());
   TimeStepper resumed(other.Problem(), times);
   StateSnapshot snapshot;
   const auto taken = [&](int steps, int failures)
   {
      force.Fail(failures);
      for (int i = 0; i < steps; i++)
      {
         REQUIRE(stepper.Step().converged);
      }
      stepper.Archive(snapshot);
   };
   const int failures = GENERATE(0, 2);
   taken(2, 0);
   if (failures > 0)
   {
      taken(1, failures);
      CHECK(stepper.Time() == 8.0); // of 14
   }
   snapshot.Rewind();
   resumed.Archive(snapshot);
   std::vector<real_t> expected;
   std::vector<real_t> found;
   while (!stepper.Done())
   {
      REQUIRE(stepper.Step().converged);
      expected.push_back(stepper.Time());
   }
   while (!resumed.Done())
   {
      REQUIRE(resumed.Step().converged);
      found.push_back(resumed.Time());
   }
   CHECK(found == expected);
   CHECK(std::count(found.begin(), found.end(), 14.0) == 1);
}

TEST_CASE("As many steps are counted as are taken")
{
   TimeOptions times;
   times.step = 3.0;
   CHECK(CountSteps(times, 9.0) == 3);
   CHECK(CountSteps(times, 10.0) == 4);
   times.growth = 2.0;
   times.max_step = 10.0;
   CHECK(CountSteps(times, 9.0) == 2); // 3 and 6
   CHECK(CountSteps(times, 29.0) == 4);
   CHECK(CountSteps(times, 30.0) == 5);
}

TEST_CASE("Options that make no sense are refused")
{
   PressedBox box(MPI_COMM_WORLD, PressedBoxOptions());
   TimeOptions options = Steps(10.0);
   std::string message;
   SECTION("min_step")
   {
      options.min_step = 11.0;
      message = "min_step is 11; it must be positive and not above the time "
                "step, 10, or 0 (derived)";
   }
   SECTION("max_step")
   {
      options.adaptive = true;
      options.max_step = 1.0;
      message =
         "max_step is 1; it must be at least the time step, 10, or 0 (derived)";
   }
   SECTION("growth")
   {
      options.growth = 0.5;
      message = "growth is 0.5; it must be at least 1";
   }
   SECTION("growth of adaptive steps")
   {
      options.adaptive = true;
      options.growth = 1.5;
      message = "growth is 1.5; it must be left out where steps are adaptive";
   }
   SECTION("error_tolerance")
   {
      options.error_tolerance = -1.0;
      message = "error_tolerance is -1; it must be between 0 and 1";
   }
   SECTION("stops")
   {
      options.stops = {1.0, std::numeric_limits<real_t>::infinity()};
      message =
         "a time at which a step shall end is inf; it must be a finite number";
   }
   CHECK_THROWS_WITH(TimeStepper(box.Problem(), options), message);
}

TEST_CASE("Adaptive steps follow contact that comes and goes")
{
   Run fine;
   fine.times = Steps(0.5);
   const std::vector<Row> reference = Solve(fine);
   Run adaptive;
   adaptive.times = Steps(10.0);
   adaptive.times.adaptive = true;
   adaptive.times.stops = {10.0, 20.0, 30.0, 50.0, 60.0, 70.0};
   const std::vector<Row> rows = Solve(adaptive);
   const real_t largest = std::abs(reference[79].force[2]);
   int compared = 0;
   real_t error = 0.0;
   for (const Row &row : rows)
   {
      for (const Row &other : reference)
      {
         if (std::abs(row.time - other.time) < 1e-9)
         {
            error = std::max(error, std::abs(row.force[2] - other.force[2]));
            compared++;
         }
      }
   }
   CAPTURE(rows.size(), error / largest, compared);
   CHECK(compared >= 8);
   CHECK(error < 0.02 * largest);
   CHECK(2 * rows.size() < reference.size());
}
