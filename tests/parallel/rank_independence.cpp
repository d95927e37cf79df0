// ranks: 1 2 3 4
// timeout: 300
//
// A problem solved by all ranks together gives what each rank finds alone: a
// box pressed eccentrically onto a wider layer, so that contact comes and goes;
// and one on which a force acts, held by ligaments, with all that its history
// has.

#include "parallel/held_box.hpp"
#include "support/pressed_box.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t agreement = 1e-6;

struct Setup
{
   int order = 1;
   LinearMethod method = LinearMethod::direct;
   Deformation deformation = Deformation::infinitesimal;
   real_t slide = 0.0;
   FrictionOptions friction;
   SolverTuning tuning;
   real_t gap_tolerance = PressedBoxOptions().gap_tolerance;
   real_t pressure_tolerance = PressedBoxOptions().pressure_tolerance;
};

struct Row
{
   Point3 reaction;
   Point3 source_force;
   real_t peak_pressure = 0.0;
   real_t peak_traction = 0.0;
   real_t area = 0.0;
   FrictionDiagnostics friction;
   real_t outflow = 0.0;
   int newton = 0;
};

std::vector<Row> Solve(const Setup &setup, MPI_Comm comm)
{
   PressedBoxOptions options;
   options.order = setup.order;
   options.method = setup.method;
   options.deformation = setup.deformation;
   options.slide = setup.slide;
   options.friction = setup.friction;
   options.gap_tolerance = setup.gap_tolerance;
   options.pressure_tolerance = setup.pressure_tolerance;
   options.tuning = setup.tuning;
   PressedBox box(comm, options);
   TimeOptions times;
   times.end = PressedBox::end;
   times.step = 10.0;
   TimeStepper stepper(box.Problem(), times);
   std::vector<Row> rows;
   while (!stepper.Done())
   {
      const StepReport report = stepper.Step();
      CAPTURE(report.reason, report.time);
      REQUIRE(report.converged);
      CHECK(report.failures == 0);
      // With the stiffness of sliding in the hierarchy it took up to 83, for
      // solutions that were none.
      CHECK(report.solve.most_linear < 70);
      Row row;
      row.reaction = box.Force();
      const ContactDiagnostics contact = Diagnose(box.Pair());
      row.source_force = contact.source_force;
      row.peak_traction = contact.peak_traction;
      row.area = contact.area;
      row.friction = contact.friction;
      const Vector &p = stepper.State().GetBlock(1);
      row.peak_pressure = p.Size() > 0 ? p.Normlinf() : 0.0;
      MPI_Allreduce(MPI_IN_PLACE, &row.peak_pressure, 1,
                    MPITypeMap<real_t>::mpi_type, MPI_MAX, comm);
      row.outflow = box.Problem().Operator().Balance().outflow;
      row.newton = report.solve.newton;
      rows.push_back(row);
   }
   return rows;
}

void CheckTogetherAndAlone(const Setup &setup)
{
   const std::vector<Row> together = Solve(setup, MPI_COMM_WORLD);
   const std::vector<Row> alone = Solve(setup, MPI_COMM_SELF);
   REQUIRE(together.size() == alone.size());
   real_t largest_force = 0.0;
   real_t largest_pressure = 0.0;
   real_t largest_outflow = 0.0;
   real_t least_area = 1.0;
   real_t largest_area = 0.0;
   for (const Row &row : alone)
   {
      largest_force = std::max(largest_force, std::abs(row.reaction[2]));
      largest_pressure = std::max(largest_pressure, row.peak_pressure);
      largest_outflow = std::max(largest_outflow, std::abs(row.outflow));
      least_area = std::min(least_area, row.area);
      largest_area = std::max(largest_area, row.area);
   }
   // There is something to compare.
   CHECK(largest_force > 1e-3);
   CHECK(largest_pressure > 1e-3);
   CHECK(least_area < 0.7 * largest_area);
   for (size_t i = 0; i < alone.size(); i++)
   {
      CAPTURE(i, together[i].newton, alone[i].newton);
      for (int d = 0; d < 3; d++)
      {
         CHECK(std::abs(together[i].reaction[d] - alone[i].reaction[d]) <=
               agreement * std::abs(alone[i].reaction[2]));
         CHECK(
            std::abs(together[i].source_force[d] - alone[i].source_force[d]) <=
            agreement * std::abs(alone[i].source_force[2]));
      }
      CHECK(together[i].peak_pressure ==
            Approx(alone[i].peak_pressure).epsilon(agreement));
      CHECK(together[i].peak_traction ==
            Approx(alone[i].peak_traction).epsilon(agreement));
      const FrictionDiagnostics &rubbed = alone[i].friction;
      CHECK(together[i].friction.coefficient ==
            Approx(rubbed.coefficient).epsilon(agreement));
      CHECK(together[i].friction.dissipation ==
            Approx(rubbed.dissipation).epsilon(agreement));
      CHECK(together[i].friction.sliding ==
            Approx(rubbed.sliding).epsilon(agreement));
      CHECK(together[i].area == Approx(alone[i].area).epsilon(agreement));
      CHECK(std::abs(together[i].outflow - alone[i].outflow) <=
            agreement * largest_outflow);
   }
}
} // namespace

TEST_CASE("All ranks together find what each finds alone")
{
   Setup setup;
   setup.order = GENERATE(1, 2);
   setup.method = GENERATE(LinearMethod::direct, LinearMethod::block_amg);
   CAPTURE(setup.order, static_cast<int>(setup.method));
   CheckTogetherAndAlone(setup);
}

TEST_CASE("So they do in finite deformation, while the box slides")
{
   Setup setup;
   setup.deformation = Deformation::finite;
   setup.slide = 0.2;
   SECTION("with order 1") {}
   SECTION("with order 1 and multigrid")
   {
      setup.method = LinearMethod::block_amg;
   }
   SECTION("with order 2")
   {
      setup.order = 2;
   }
   CheckTogetherAndAlone(setup);
}

TEST_CASE("So they do while the box rubs")
{
   Setup setup;
   setup.deformation = Deformation::finite;
   setup.slide = 0.2;
   setup.friction.coefficient = 0.1;
   // Peaks are those of single vertices: as near as gaps and jumps are closed.
   setup.gap_tolerance = 1e-8;
   setup.pressure_tolerance = 1e-7;
   // Points that went to other faces are looked for anew whatever that changes,
   // rather than where a bound is passed.
   setup.tuning.contact.drift_of_tolerance = 0.0;
   setup.tuning.contact.drift_of_gap = 0.0;
   setup.tuning.contact.drift_of_area = 0.0;
   setup.method = GENERATE(LinearMethod::direct, LinearMethod::block_amg);
   CAPTURE(static_cast<int>(setup.method));
   CheckTogetherAndAlone(setup);
}

namespace
{
using Rows = std::vector<HeldBox::Row>;

/// What a column of the history is in a row.
real_t ValueOf(const HeldBox::Row &row, const std::string &column)
{
   INFO(column);
   const auto found =
      std::find_if(row.history.begin(), row.history.end(),
                   [&](const auto &entry) { return entry.first == column; });
   REQUIRE(found != row.history.end());
   return found->second;
}

/// Gives the rows of all ranks.
Rows CheckCase(const std::string &text)
{
   const Rows together = HeldBox(text, MPI_COMM_WORLD).March();
   const Rows alone = HeldBox(text, MPI_COMM_SELF).March();
   REQUIRE(together.size() == alone.size());
   CheckSame(together, alone, agreement);
   return together;
}

std::string WithMultigrid(const std::string &text)
{
   return Replaced(text, "\"direct\"", "\"block_amg\"");
}

/// With factors the last iteration closes gaps to round-off; what multigrid
/// leaves of them, and of the residual, depends on the ranks.
std::string WithClosedGaps(const std::string &text)
{
   const std::string accurate =
      Replaced(WithMultigrid(text), "[solver]", "[solver]\ntolerance = 1e-10");
   return Replaced(accurate, "friction = ",
                   "gap_tolerance = 1e-8\npressure_tolerance = 1e-7\n"
                   "friction = ");
}

std::string WithFibers()
{
   return Replaced(
      held_box, "solid = {model = \"neo_hookean\", E = 5, nu = 0.2}",
      "solid = {model = \"mixture\", solids = ["
      "{model = \"holmes_mow\", E = 0.5, nu = 0.2, beta = 0.35}, "
      "{model = \"fiber_pow_linear\", E = 50, lam0 = 1.01, beta = 3}]}\n"
      "frame = {type = \"cartesian\", axis = [1, 2, 0]}");
}

std::string Tied()
{
   return Replaced(Replaced(held_box, "[[contact]]", "[[tie]]"),
                   "friction = {coefficient = 0.3}\n", "");
}
} // namespace

TEST_CASE("So they do where a free rigid body is held by ligaments and rubs")
{
   const bool multigrid = GENERATE(false, true);
   CAPTURE(multigrid);
   const Rows rows = CheckCase(multigrid ? WithClosedGaps(held_box) : held_box);
   const HeldBox::Row &pressed = rows[2];
   const HeldBox::Row &pulled = rows.back();
   // There is something to compare.
   CHECK(ValueOf(pulled, "contact.gap.area") <
         0.9 * ValueOf(pressed, "contact.gap.area"));
   CHECK(ValueOf(rows[3], "contact.gap.sliding") > 0.5);
   CHECK(ValueOf(pulled, "contact.gap.dissipation") > 0.0);
   CHECK(ValueOf(pulled, "rigid_body.bone.translation_x") > 0.005);
   CHECK(ValueOf(pulled, "joint.joint.lateral") > 0.005);
   CHECK(std::abs(ValueOf(pulled, "joint.joint.abduction")) > 0.005);
   CHECK(ValueOf(pulled, "ligament.back.force") > 1e-3);
}

TEST_CASE("So they do where that has fibers")
{
   const bool multigrid = GENERATE(false, true);
   CAPTURE(multigrid);
   const std::string text = WithFibers();
   const Rows rows = CheckCase(multigrid ? WithClosedGaps(text) : text);
   CHECK(ValueOf(rows.back(), "contact.gap.dissipation") > 0.0);
}

TEST_CASE("So they do where it is tied")
{
   const bool multigrid = GENERATE(false, true);
   CAPTURE(multigrid);
   const Rows rows = CheckCase(multigrid ? WithMultigrid(Tied()) : Tied());
   CHECK(ValueOf(rows.back(), "tie.gap.force_x") > 1e-3);
   CHECK(ValueOf(rows.back(), "fluid.peak_pressure") > 1e-3);
}
