// ranks: 1 3
// timeout: 300
//
// A run that is resumed from a checkpoint, by as many ranks as wrote it or by
// others, goes on as the run that was not interrupted: a box is pressed onto a
// layer, and its contact comes and goes.

#include "parallel/held_box.hpp"
#include "support/gathered_order.hpp"
#include "support/pressed_box.hpp"
#include "support/temporary_directory.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
struct Setup
{
   TimeOptions times;
   int order = 1;
   LinearMethod method = LinearMethod::direct;
   Deformation deformation = Deformation::infinitesimal;
   SearchConfiguration configuration = SearchConfiguration::reference;
   real_t slide = 0.0;
   SolverTuning tuning;
   real_t gap_tolerance = 0.0;
   real_t pressure_tolerance = ContactOptions().pressure_tolerance;
   FrictionOptions friction;
   /// The checkpoint is written once this time is passed.
   real_t interruption = 0.0;
};

struct Row
{
   real_t time = 0.0;
   Point3 force;
   real_t area = 0.0;
   FrictionDiagnostics friction;
   /// All dofs in an order that does not depend on the ranks; on rank 0.
   std::vector<double> displacement;
   std::vector<double> pressure;
   std::vector<double> traction;
};

PressedBoxOptions Options(const Setup &setup)
{
   PressedBoxOptions options;
   options.order = setup.order;
   options.method = setup.method;
   options.deformation = setup.deformation;
   options.configuration = setup.configuration;
   options.slide = setup.slide;
   options.relative_tolerance = 1e-12;
   options.tuning = setup.tuning;
   options.gap_tolerance = setup.gap_tolerance;
   options.pressure_tolerance = setup.pressure_tolerance;
   options.friction = setup.friction;
   return options;
}

std::vector<double> Gather(PressedBox &box, const ParFiniteElementSpace &space,
                           const Vector &values)
{
   return GatherInOrder(box.Problem().Mesh(), space, values);
}

/// Goes on until @a until is passed, or to the end.
std::vector<Row> March(PressedBox &box, TimeStepper &stepper, real_t until)
{
   std::vector<Row> rows;
   BiphasicSpaces &spaces = box.Problem().Spaces();
   while (!stepper.Done() && stepper.Time() < until)
   {
      const StepReport report = stepper.Step();
      CAPTURE(report.reason, report.time);
      REQUIRE(report.converged);
      Row row;
      row.time = report.time;
      row.force = box.Force();
      row.area = report.contact_area;
      row.friction = Diagnose(box.Pair()).friction;
      row.displacement =
         Gather(box, spaces.Displacement(), stepper.State().GetBlock(0));
      row.pressure =
         Gather(box, spaces.Pressure(), stepper.State().GetBlock(1));
      row.traction =
         Gather(box, spaces.Multiplier(),
                box.Pair().Geometry().Destination().Vertices().ToTrueDofs(
                   box.Pair().State().traction));
      rows.push_back(row);
   }
   return rows;
}

std::vector<Row> Whole(const Setup &setup, MPI_Comm comm)
{
   PressedBox box(comm, Options(setup));
   TimeStepper stepper(box.Problem(), setup.times);
   return March(box, stepper, PressedBox::end);
}

std::string WriteHalfway(const Setup &setup, const std::string &directory,
                         MPI_Comm comm)
{
   PressedBox box(comm, Options(setup));
   TimeStepper stepper(box.Problem(), setup.times);
   March(box, stepper, setup.interruption);
   return WriteCheckpoint(directory, box.Problem(), stepper);
}

/// A run that writes a checkpoint on its way.
struct WatchedRun
{
   std::vector<Row> rows;
   std::string file;
};

WatchedRun RunThrough(const Setup &setup, const std::string &directory,
                      MPI_Comm comm)
{
   PressedBox box(comm, Options(setup));
   TimeStepper stepper(box.Problem(), setup.times);
   WatchedRun run;
   run.rows = March(box, stepper, setup.interruption);
   run.file = WriteCheckpoint(directory, box.Problem(), stepper);
   for (Row &row : March(box, stepper, PressedBox::end))
   {
      run.rows.push_back(std::move(row));
   }
   return run;
}

std::vector<Row> Resume(const Setup &setup, const std::string &file,
                        MPI_Comm comm)
{
   PressedBox box(comm, Options(setup));
   TimeStepper stepper(box.Problem(), setup.times);
   ReadCheckpoint(file, box.Problem(), stepper);
   CHECK(stepper.Time() >= setup.interruption);
   return March(box, stepper, PressedBox::end);
}

/// Largest magnitude of a field in a run.
real_t Largest(const std::vector<Row> &rows, std::vector<double> Row::*field)
{
   real_t largest = 0.0;
   for (const Row &row : rows)
   {
      for (const double value : row.*field)
      {
         largest = std::max(largest, std::abs(value));
      }
   }
   return largest;
}

void CheckNear(const std::vector<double> &a, const std::vector<double> &b,
               real_t tolerance)
{
   REQUIRE(a.size() == b.size());
   real_t difference = 0.0;
   for (std::size_t i = 0; i < a.size(); i++)
   {
      difference = std::max(difference, std::abs(a[i] - b[i]));
   }
   CAPTURE(difference / tolerance);
   CHECK(difference <= tolerance);
}

/// The resumed run, whose rows are the last ones, against the whole one.
void Compare(const std::vector<Row> &resumed, const std::vector<Row> &whole,
             real_t tolerance)
{
   REQUIRE(resumed.size() < whole.size());
   // Contact changes in what is compared.
   CHECK(resumed.back().area < 0.8 * resumed.front().area);
   const std::size_t before = whole.size() - resumed.size();
   for (std::size_t i = 0; i < resumed.size(); i++)
   {
      const Row &a = resumed[i];
      const Row &b = whole[before + i];
      CAPTURE(i, a.time, b.time);
      CHECK(a.time == Approx(b.time).epsilon(tolerance));
      CHECK(a.area == Approx(b.area).epsilon(tolerance));
      CHECK(a.friction.dissipation ==
            Approx(b.friction.dissipation).epsilon(tolerance).margin(1e-15));
      CHECK(a.friction.sliding ==
            Approx(b.friction.sliding).epsilon(tolerance));
      for (int d = 0; d < 3; d++)
      {
         CHECK(std::abs(a.force[d] - b.force[d]) <=
               tolerance * std::abs(b.force[2]));
      }
      CheckNear(a.displacement, b.displacement,
                tolerance * Largest(whole, &Row::displacement));
      CheckNear(a.pressure, b.pressure,
                tolerance * Largest(whole, &Row::pressure));
      CheckNear(a.traction, b.traction,
                tolerance * Largest(whole, &Row::traction));
   }
}

/// The first @a count ranks; MPI_COMM_NULL on the others.
class FirstRanks
{
public:
   explicit FirstRanks(int count)
   {
      const int rank = Mpi::WorldRank();
      MPI_Comm_split(MPI_COMM_WORLD, rank < count ? 0 : MPI_UNDEFINED, rank,
                     &comm);
   }
   ~FirstRanks()
   {
      if (Has())
      {
         MPI_Comm_free(&comm);
      }
   }
   FirstRanks(const FirstRanks &) = delete;
   FirstRanks &operator=(const FirstRanks &) = delete;
   bool Has() const { return comm != MPI_COMM_NULL; }
   MPI_Comm Get() const { return comm; }

private:
   MPI_Comm comm;
};

Setup MakeSetup()
{
   Setup setup;
   setup.times.end = PressedBox::end;
   setup.times.step = 5.0;
   setup.interruption = 30.0;
   SECTION("with fixed steps and order 1") {}
   SECTION("with order 2, three stages, amid a segment of the load")
   {
      setup.order = 2;
      setup.times.scheme = TimeScheme::sdirk33;
      setup.times.step = 10.0;
      setup.interruption = 50.0;
   }
   SECTION("with adaptive steps")
   {
      setup.times.adaptive = true;
      setup.times.error_tolerance = 2e-2;
   }
   SECTION("with adaptive steps, on a corner of the load")
   {
      setup.times.adaptive = true;
      setup.times.error_tolerance = 2e-2;
      setup.interruption = 40.0;
   }
   return setup;
}
} // namespace

TEST_CASE("A run resumed by as many ranks equals the uninterrupted one")
{
   Setup setup = MakeSetup();
   // This solver keeps less from one step to the next than the other one: a
   // hierarchy, which is not in the checkpoint. All the rest must be.
   setup.method = LinearMethod::block_amg;
   const TemporaryDirectory directory;
   const WatchedRun whole = RunThrough(setup, directory.Path(), MPI_COMM_WORLD);
   Compare(Resume(setup, whole.file, MPI_COMM_WORLD), whole.rows, 1e-12);
}

TEST_CASE("A run resumed by more ranks, or on the first of them, equals the "
          "uninterrupted one")
{
   const Setup setup = MakeSetup();
   const int size = Mpi::WorldSize();
   const TemporaryDirectory directory;
   const FirstRanks fewer(std::max(1, size - 1));
   if (fewer.Has())
   {
      WriteHalfway(setup, directory.Path(), fewer.Get());
   }
   MPI_Barrier(MPI_COMM_WORLD);
   const std::string file =
      FindCheckpoint(directory.Path(), MPI_COMM_WORLD).file;
   CHECK_FALSE(file.empty());
   const std::vector<Row> whole = Whole(setup, MPI_COMM_WORLD);
   Compare(Resume(setup, file, MPI_COMM_WORLD), whole, 1e-8);
   const std::vector<Row> alone = Resume(setup, file, MPI_COMM_SELF);
   if (Mpi::Root())
   {
      Compare(alone, whole, 1e-8);
   }
}

namespace
{
/// Of a box that slides when the checkpoint is written.
Setup MakeSlidingSetup()
{
   Setup setup;
   setup.times.end = PressedBox::end;
   setup.times.step = 10.0;
   setup.interruption = 40.0;
   setup.slide = 0.2;
   return setup;
}
} // namespace

TEST_CASE(
   "A run resumed in finite deformation, while the box slides, equals the "
   "uninterrupted one")
{
   Setup setup = MakeSlidingSetup();
   setup.deformation = Deformation::finite;
   // The resumed run begins from other factors. For them to have no say in what
   // Newton's method ends with, its last iterations are complete and solved to
   // the end, and gaps and jumps are closed.
   setup.tuning.newton.kept_tangent = 0.0;
   setup.tuning.newton.largest_forcing = 1e-6;
   setup.tuning.newton.final_accuracy = 1e-3;
   setup.gap_tolerance = 1e-9;
   setup.pressure_tolerance = 1e-9;
   // Nor where points are when they are made anew.
   setup.tuning.contact.drift_of_tolerance = 0.0;
   setup.tuning.contact.drift_of_gap = 0.0;
   setup.tuning.contact.drift_of_area = 0.0;
   SECTION("with partners that each step looks for") {}
   SECTION("with those of former steps until it slides")
   {
      // With points of every step a seal that goes to and fro stays as the
      // iterates of the solve found it.
      setup.tuning.contact.kept_slide = 0.2;
   }
   const TemporaryDirectory directory;
   const WatchedRun whole = RunThrough(setup, directory.Path(), MPI_COMM_WORLD);
   Compare(Resume(setup, whole.file, MPI_COMM_WORLD), whole.rows, 1e-10);
}

TEST_CASE("A run resumed in infinitesimal strain, while the box slides, equals "
          "the uninterrupted one")
{
   Setup setup = MakeSlidingSetup();
   setup.configuration = SearchConfiguration::current;
   setup.method = LinearMethod::block_amg;
   SECTION("with operators that each step finds") {}
   SECTION("with those of former steps until it slides")
   {
      setup.tuning.contact.kept_slide = 0.2;
   }
   const TemporaryDirectory directory;
   const WatchedRun whole = RunThrough(setup, directory.Path(), MPI_COMM_WORLD);
   Compare(Resume(setup, whole.file, MPI_COMM_WORLD), whole.rows, 1e-10);
}

TEST_CASE("A run resumed while the box rubs equals the uninterrupted one")
{
   Setup setup = MakeSlidingSetup();
   setup.deformation = Deformation::finite;
   setup.friction.coefficient = 0.1;
   setup.tuning.newton.kept_tangent = 0.0;
   setup.tuning.newton.largest_forcing = 1e-6;
   setup.tuning.newton.final_accuracy = 1e-3;
   // As above; and points that went to other faces are looked for anew whatever
   // that changes, rather than where a bound is passed.
   setup.tuning.contact.drift_of_tolerance = 0.0;
   setup.tuning.contact.drift_of_gap = 0.0;
   setup.tuning.contact.drift_of_area = 0.0;
   const TemporaryDirectory directory;
   const WatchedRun whole = RunThrough(setup, directory.Path(), MPI_COMM_WORLD);
   Compare(Resume(setup, whole.file, MPI_COMM_WORLD), whole.rows, 1e-8);
}

TEST_CASE("A run with a free rigid body that rubs, resumed by more ranks or on "
          "the first of them, equals the uninterrupted one")
{
   constexpr real_t interruption = 15.0;
   const int size = Mpi::WorldSize();
   const TemporaryDirectory directory;
   const FirstRanks fewer(std::max(1, size - 1));
   if (fewer.Has())
   {
      HeldBox box(held_box, fewer.Get());
      box.March(interruption);
      WriteCheckpoint(directory.Path(), box.Problem(), box.Stepper());
   }
   MPI_Barrier(MPI_COMM_WORLD);
   const std::string file =
      FindCheckpoint(directory.Path(), MPI_COMM_WORLD).file;
   CHECK_FALSE(file.empty());
   const auto whole = HeldBox(held_box, MPI_COMM_WORLD).March();
   const auto resume = [&](MPI_Comm comm)
   {
      HeldBox box(held_box, comm);
      ReadCheckpoint(file, box.Problem(), box.Stepper());
      CHECK(box.Stepper().Time() == Approx(interruption));
      return box.March();
   };
   CheckSame(resume(MPI_COMM_WORLD), whole, 1e-6);
   CheckSame(resume(MPI_COMM_SELF), whole, 1e-6);
}
