// ranks: 1 2 3
//
// Steps of finite deformation: adaptive ones against the reference, a run that
// is resumed, and loads beyond what bodies can take: a step that would turn
// elements inside out or close their pores is cut, and what is left in the end
// is the last state that was good, with the reason.

#include "support/boxes.hpp"
#include "support/reference_table.hpp"
#include "support/temporary_directory.hpp"
#include "synovia/fem/strain_monitor.hpp"
#include "synovia/io/checkpoint.hpp"
#include "synovia/io/checkpoint_directory.hpp"
#include "synovia/materials/permeabilities/constant_permeability.hpp"
#include "synovia/materials/permeabilities/holmes_mow_permeability.hpp"
#include "synovia/materials/solids/holmes_mow.hpp"
#include "synovia/materials/solids/neo_hookean.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <memory>

using namespace mfem;
using namespace synovia;

namespace
{
SpaceOptions Finite(int order)
{
   SpaceOptions space;
   space.order = order;
   space.deformation = Deformation::finite;
   return space;
}

/// A box that is confined, or glued between plates and drained on one side, and
/// pressed by its top.
struct Column
{
   Column(const BoxOptions &box, int order, bool confined, const LoadCurve &top,
          real_t solid_fraction = 0.2)
      : mesh(MakeBox(box)), problem(mesh, Finite(order))
   {
      problem.SetMaterial("body", solid, permeability, solid_fraction);
      problem.PrescribeDisplacement("z0", 2, 0.0);
      for (int d = 0; d < 2; d++)
      {
         if (confined)
         {
            problem.PrescribeDisplacement(d == 0 ? "x0" : "y0", d, 0.0);
            problem.PrescribeDisplacement(d == 0 ? "x1" : "y1", d, 0.0);
         }
         else
         {
            problem.PrescribeDisplacement("z0", d, 0.0);
            problem.PrescribeDisplacement("z1", d, 0.0);
         }
      }
      problem.PrescribeDisplacement("z1", 2, top);
      problem.PrescribePressure(confined ? "z1" : "x1", 0.0);
      NonlinearOptions nonlinear;
      nonlinear.linear.relative_tolerance = 1e-12;
      problem.SetNonlinearOptions(nonlinear);
   }

   const HolmesMow solid{0.5, 0.1, 0.5};
   const HolmesMowPermeability permeability{4.0e-3, 2.0, 2.0, 0.2};
   NamedMesh mesh;
   BiphasicProblem problem;
};

// Marches to the end and gives the state.
Vector March(TimeStepper &stepper)
{
   while (!stepper.Done())
   {
      const StepReport report = stepper.Step();
      INFO(report.reason);
      REQUIRE(report.converged);
   }
   return stepper.State();
}

real_t LargestDifference(const Vector &a, const Vector &b)
{
   Vector difference(a);
   difference -= b;
   real_t largest[2] = {difference.Normlinf(), b.Normlinf()};
   MPI_Allreduce(MPI_IN_PLACE, largest, 2, MPITypeMap<real_t>::mpi_type,
                 MPI_MAX, MPI_COMM_WORLD);
   return largest[0] / largest[1];
}

BoxOptions Block()
{
   BoxOptions box;
   box.nx = box.ny = 2;
   box.nz = 3;
   return box;
}

struct FailedRun
{
   /// Of the step that failed.
   StepReport last;
   /// Tries of all steps that failed.
   int failures = 0;
};

// Marches until a step fails.
FailedRun Fail(TimeStepper &stepper)
{
   FailedRun run;
   do
   {
      REQUIRE_FALSE(stepper.Done());
      run.last = stepper.Step();
      run.failures += run.last.failures;
   } while (run.last.converged);
   return run;
}
} // namespace

TEST_CASE("Adaptive steps of finite deformation meet the reference")
{
   BoxOptions box;
   box.nz = 20;
   box.size_x = box.size_y = 0.1;
   Column column(box, 2, true, Ramp(500.0, -0.3));
   TimeOptions times;
   times.end = 1000.0;
   times.step = 10.0;
   times.adaptive = true;
   times.error_tolerance = 1e-3;
   times.scheme = GENERATE(TimeScheme::sdirk23, TimeScheme::sdirk33);
   times.stops = {250.0};
   TimeStepper stepper(column.problem, times);
   const ReferenceTable reference("finite_confined_holmesmow.csv");
   int compared = 0;
   real_t shortest = times.end;
   real_t longest = 0.0;
   while (!stepper.Done())
   {
      const StepReport report = stepper.Step();
      INFO(report.reason);
      REQUIRE(report.converged);
      shortest = std::min(shortest, report.dt);
      longest = std::max(longest, report.dt);
      for (const real_t t : {250.0, 500.0, 1000.0})
      {
         if (std::abs(stepper.Time() - t) < 1e-9)
         {
            const real_t stress =
               column.problem.Reaction(column.problem.Supports().back())[2] /
               (box.size_x * box.size_y);
            CAPTURE(t);
            CHECK(stress ==
                  Approx(reference.Find({{"t", t}}, "stress")).epsilon(5e-3));
            compared++;
         }
      }
   }
   CHECK(compared == 3);
   CAPTURE(shortest, longest, stepper.Steps());
   CHECK(longest > 5.0 * shortest);
   CHECK(stepper.Steps() < 150);
}

TEST_CASE("A resumed run in finite deformation equals the uninterrupted one")
{
   TimeOptions times;
   times.end = 40.0;
   times.step = 5.0;
   times.scheme = GENERATE(TimeScheme::backward_euler, TimeScheme::sdirk33);
   times.adaptive = GENERATE(false, true);
   const int order = GENERATE(1, 2);
   CAPTURE(static_cast<int>(times.scheme), times.adaptive, order);
   const LoadCurve top = Ramp(30.0, -0.3);
   Vector whole;
   {
      Column column(Block(), order, false, top);
      TimeStepper stepper(column.problem, times);
      whole = March(stepper);
   }
   const TemporaryDirectory directory;
   {
      Column column(Block(), order, false, top);
      TimeStepper stepper(column.problem, times);
      while (stepper.Time() < 15.0)
      {
         REQUIRE(stepper.Step().converged);
      }
      WriteCheckpoint(directory.Path(), column.problem, stepper);
   }
   Column column(Block(), order, false, top);
   TimeStepper stepper(column.problem, times);
   const std::string file =
      FindCheckpoint(directory.Path(), MPI_COMM_WORLD).file;
   ReadCheckpoint(file, column.problem, stepper);
   CHECK(stepper.Time() >= 15.0);
   CHECK(LargestDifference(March(stepper), whole) < 1e-10);
}

TEST_CASE("A checkpoint of finite deformation is none of infinitesimal strain")
{
   const TemporaryDirectory directory;
   {
      Column column(Block(), 1, false, Ramp(30.0, -0.1));
      TimeOptions times;
      TimeStepper stepper(column.problem, times);
      WriteCheckpoint(directory.Path(), column.problem, stepper);
   }
   NamedMesh mesh = MakeBox(Block());
   SpaceOptions space;
   space.order = 1;
   BiphasicProblem linear(mesh, space);
   const IsotropicElastic solid(0.5, 0.1);
   const ConstantPermeability permeability(4.0e-3);
   linear.SetMaterial("body", solid, permeability);
   linear.FixDisplacement("z0");
   linear.PrescribePressure("z1", 0.0);
   TimeOptions times;
   TimeStepper stepper(linear, times);
   const std::string file =
      FindCheckpoint(directory.Path(), MPI_COMM_WORLD).file;
   CHECK_THROWS_WITH(
      ReadCheckpoint(file, linear, stepper),
      Catch::Contains("deformation: finite there, infinitesimal here"));
}

TEST_CASE("A plate that is pushed through a body stops before, and says why")
{
   const int order = GENERATE(1, 2);
   Column column(Block(), order, false, Ramp(10.0, -2.0), 1e-3);
   TimeOptions times;
   times.end = 10.0;
   times.step = 1.0;
   times.min_step = 0.02;
   TimeStepper stepper(column.problem, times);
   const FailedRun run = Fail(stepper);
   CAPTURE(run.last.reason, run.last.failures, stepper.Time());
   // Halves of 1 down to 0.02.
   CHECK(run.failures >= 5);
   CHECK(run.last.failures > 0);
   CHECK_THAT(run.last.reason, Catch::Contains("a step is not cut below"));
   // The last good state: compressed by far, nothing inside out.
   CHECK(stepper.Time() > 2.0);
   CHECK(stepper.Time() < 5.0);
   const StrainExtremes strains =
      StrainMonitor(column.mesh, stepper.Displacement(), Deformation::finite)
         .Measure();
   CHECK(strains.max_principal.value < std::log(0.6));
   const TemporaryDirectory directory;
   WriteCheckpoint(directory.Path(), column.problem, stepper);
   Column again(Block(), order, false, Ramp(10.0, -2.0), 1e-3);
   TimeStepper next(again.problem, times);
   ReadCheckpoint(FindCheckpoint(directory.Path(), MPI_COMM_WORLD).file,
                  again.problem, next);
   CHECK(LargestDifference(next.State(), stepper.State()) < 1e-14);
}

TEST_CASE("A column whose pores close says which element and where")
{
   // A fraction of solid of 0.5: the permeability would go on to 0.2.
   Column column(Block(), 1, true, Ramp(1000.0, -0.8), 0.5);
   TimeOptions times;
   times.end = 1000.0;
   times.step = 50.0;
   times.min_step = 5.0;
   TimeStepper stepper(column.problem, times);
   const StepReport report = Fail(stepper).last;
   CAPTURE(report.reason, stepper.Time());
   CHECK_THAT(report.reason,
              Catch::Contains("the body has no pores left, as its solid "
                              "fraction is 0.5 at (") &&
                 Catch::Contains("), as meshed, in element ") &&
                 Catch::Contains(" of \"body\": det F = "));
   CHECK(stepper.Time() > 300.0);
   CHECK(stepper.Time() < 0.5 / 0.8 * 1000.0);
   const StrainExtremes strains =
      StrainMonitor(column.mesh, stepper.Displacement(), Deformation::finite)
         .Measure();
   CHECK(strains.min_det_F.value > 0.5 - 1e-3);
}
