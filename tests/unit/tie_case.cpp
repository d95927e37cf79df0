// ranks: 1 2
//
// [[tie]] in case files: what it says, what is refused and where, its row in
// the report, its columns of the history, and the warnings of bodies that it
// holds and drains.

#include "support/box_case.hpp"
#include "support/boxes.hpp"
#include "support/temporary_directory.hpp"
#include "synovia/cases/case_problem.hpp"
#include "synovia/cases/case_steps.hpp"
#include "synovia/checks/case_warnings.hpp"
#include "synovia/checks/tie_check.hpp"
#include "synovia/general/error.hpp"
#include "synovia/io/checkpoint.hpp"
#include "synovia/io/step_diagnostics.hpp"
#include "synovia/runs/problem_report.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

using namespace mfem;
using namespace synovia;
using Catch::Matchers::Contains;

namespace
{
const std::string good = R"([mesh]
file = "stack.msh"
[space]
order = 1
[[material]]
regions = "lower"
solid = {E = 0.5, nu = 0.1}
permeability = {value = 4e-3}
[[material]]
regions = "upper"
solid = {E = 1.5, nu = 0.1}
permeability = {value = 1e-3}
[[boundary]]
surfaces = "lower_z0"
displacement = [0, 0, 0]
[[boundary]]
surfaces = "upper_z1"
pressure = 0
traction = [0.001, 0, {times = [0, 10], values = [0, -0.02]}]
[[tie]]
name = "glue"
source = "upper_z0"
destination = "lower_z1"
search_radius = 0.1
pressure_tolerance = 1e-5
[time]
end = 20
step = 5
)";

void CheckGood(const CaseFile &setup)
{
   REQUIRE(setup.ties.size() == 1);
   const TieCase &tie = setup.ties[0];
   CHECK(tie.Name() == "glue");
   CHECK(tie.source == std::vector<std::string>{"upper_z0"});
   CHECK(tie.destination == std::vector<std::string>{"lower_z1"});
   CHECK(tie.options.search_radius == 0.1);
   CHECK(tie.options.displacement_tolerance == 0.0);
   CHECK(tie.options.pressure_tolerance == 1e-5);
}

/// The upper box is as wide as @a width.
NamedMesh StackOf(real_t width = 1.0)
{
   BoxOptions lower;
   lower.nx = 3;
   lower.ny = 3;
   lower.nz = 2;
   BoxOptions upper = lower;
   upper.nx = 2;
   upper.ny = 2;
   upper.size_x = width;
   return MakeStack(lower, upper);
}

std::string ErrorOfStack(const std::string &text)
{
   try
   {
      const CaseFile setup = ParseCase(text, "case.toml");
      NamedMesh mesh = StackOf();
      CaseProblem problem(setup, mesh);
      CheckTies(setup, problem);
      problem.Get().Operator();
   }
   catch (const Error &error)
   {
      return error.what();
   }
   return "";
}

class Run
{
public:
   explicit Run(const std::string &text = good)
      : setup(ParseCase(text, "case.toml")), mesh(StackOf()),
        problem(setup, mesh), stepper(problem.Get(), setup.time)
   {
   }

   History::Row Step()
   {
      const StepReport report = stepper.Step();
      INFO(report.reason);
      REQUIRE(report.converged);
      return StepDiagnostics(problem.Get(), stepper, report);
   }

   CaseFile setup;
   NamedMesh mesh;
   CaseProblem problem;
   TimeStepper stepper;
};

real_t ValueIn(const History::Row &row, const std::string &column)
{
   const auto found =
      std::find_if(row.begin(), row.end(),
                   [&](const auto &entry) { return entry.first == column; });
   INFO(column);
   REQUIRE(found != row.end());
   return found->second;
}
} // namespace

TEST_CASE("A tie of a case file is what it says, also written anew")
{
   const CaseFile setup = ParseCase(good, "case.toml");
   CheckGood(setup);
   std::ostringstream written;
   WriteCase(setup, written);
   CheckGood(ParseCase(written.str(), "written.toml"));
   CHECK(ParseCase(Replaced(good, "name = \"glue\"\n", ""), "case.toml")
            .ties[0]
            .Name() == "upper_z0-lower_z1");
}

TEST_CASE("What contradicts itself about ties is an error at its place")
{
   struct Wrong
   {
      std::string from;
      std::string to;
      std::vector<std::string> texts;
   };
   const std::string again = "[[tie]]\nsource = \"upper_x0\"\ndestination = "
                             "\"lower_x0\"\nname = \"glue\"\n[time]";
   const Wrong wrong = GENERATE_COPY(values<Wrong>({
      {"source = \"upper_z0\"\n", "", {"tie.0.source", "missing"}},
      {"source = \"upper_z0\"",
       "source = \"upper_zO\"",
       {"case.toml:22", "tie.0.source.0", "did you mean", "upper_z0"}},
      {"source = \"upper_z0\"",
       "source = [\"upper_z0\", \"lower_z1\"]",
       {"tie.0.destination", "\"lower_z1\" is tied already"}},
      {"name = \"glue\"", "name = \"a/b\"", {"tie.0.name", "no slash"}},
      {"[time]", again, {"tie.1", "a tie is called \"glue\" already"}},
      {"[time]",
       "[[contact]]\nsource = \"upper_z0\"\ndestination = \"lower_x0\"\n[time]",
       {"tie.0.source", "\"upper_z0\" is in a contact pair as well",
        "case.toml:26"}},
      {"search_radius = 0.1",
       "search_radius = -0.1",
       {"tie.0.search_radius", "-0.1"}},
      {"pressure_tolerance = 1e-5",
       "displacement_tolerance = -1e-6",
       {"case.toml:25", "tie.0.displacement_tolerance: found -1e-06",
        "positive, or \"auto\""}},
      {"pressure_tolerance = 1e-5",
       "displacement_tolerance = 0",
       {"tie.0.displacement_tolerance: found 0", "positive, or \"auto\""}},
      {"pressure_tolerance = 1e-5",
       "displacement_tolerance = [1e-6]",
       {"tie.0.displacement_tolerance: found a list of 1"}},
      {"pressure_tolerance = 1e-5",
       "pressure_tolerance = 0",
       {"tie.0.pressure_tolerance", "positive"}},
      {"pressure_tolerance", "presure_tolerance", {"presure_tolerance"}},
      {"destination = \"lower_z1\"",
       "destination = [\"lower_z1\", \"upper_x0\"]",
       {"tie.0", "tie \"glue\"", "share vertices", "without a tie"}},
      {"destination = \"lower_z1\"",
       "destination = \"lower_z0\"",
       {"tie.0", "tie \"glue\"", "within the search radius of 0.1"}},
   }));
   CAPTURE(wrong.from, wrong.to);
   const std::string error = ErrorOfStack(Replaced(good, wrong.from, wrong.to));
   for (const std::string &part : wrong.texts)
   {
      CHECK_THAT(error, Contains(part));
   }
   CHECK(ErrorOfStack(good).empty());
}

TEST_CASE("A rigid side is refused")
{
   std::string text = Replaced(good, R"([[material]]
regions = "upper"
solid = {E = 1.5, nu = 0.1}
permeability = {value = 1e-3}
)",
                               R"([[rigid_body]]
name = "plate"
regions = "upper"
)");
   text = Replaced(text, R"([[boundary]]
surfaces = "upper_z1"
pressure = 0
traction = [0.001, 0, {times = [0, 10], values = [0, -0.02]}]
)",
                   "");
   CHECK_THAT(ErrorOfStack(text),
              Contains("tie.0") && Contains("its source is a rigid body; list "
                                            "the surface of the other side"));
}

TEST_CASE("The report has what ties cover, and that they hold and drain")
{
   const CaseFile setup = ParseCase(good, "case.toml");
   const auto report_of = [&](real_t width, const CaseFile &of)
   {
      NamedMesh mesh = StackOf(width);
      CaseProblem problem(of, mesh);
      std::ostringstream report;
      ProblemReport(of, problem).Write(report);
      return report.str();
   };
   const std::string text = report_of(1.0, setup);
   CHECK_THAT(text, Contains("ties\n") && Contains("largest distance"));
   const size_t at = text.find("glue", text.find("ties\n"));
   REQUIRE(at != std::string::npos);
   const std::string row = text.substr(at, text.find('\n', at) - at);
   CHECK_THAT(row, Contains("100 %") && Contains("0.1") && Contains("passes"));
   // The lower box drains through the upper one, which it holds.
   CHECK_THAT(text, !Contains("no fluid can leave") &&
                       !Contains("nothing holds") && !Contains("hint: case"));
   CHECK_THAT(
      report_of(0.5, setup),
      Contains("the source covers 50 % of the destination of \"glue\""));
   CaseFile loose = setup;
   loose.ties.clear();
   NamedMesh mesh = StackOf();
   CHECK_THROWS_WITH(CaseProblem(loose, mesh),
                     Contains("nothing holds \"upper\""));
}

TEST_CASE("The history has force, moment and flow of each tie")
{
   Run run;
   run.Step();
   const History::Row row = run.Step();
   CHECK(ValueIn(row, "tie.glue.force_x") == Approx(0.001).epsilon(1e-6));
   CHECK(ValueIn(row, "tie.glue.force_z") == Approx(-0.02).epsilon(1e-6));
   // About the origin, of the load on the top at x = y = 1/2 and z = 2.
   CHECK(ValueIn(row, "tie.glue.moment_y") ==
         Approx(0.001 * 2.0 + 0.02 * 0.5).epsilon(0.01));
   CHECK(ValueIn(row, "tie.glue.force_error") <= 1e-12);
   CHECK(ValueIn(row, "tie.glue.moment_error") <= 1e-9);
   CHECK(ValueIn(row, "tie.glue.displacement_jump") <= 1e-6);
   CHECK(ValueIn(row, "tie.glue.pressure_jump") <=
         1e-5 * ValueIn(row, "fluid.peak_pressure"));
   // Out of the lower box, up.
   CHECK(ValueIn(row, "tie.glue.fluid_exchange") < 0.0);
   CHECK(ValueIn(row, "tie.glue.fluid_exchange") >
         -ValueIn(row, "fluid.outflow"));
}

TEST_CASE("A tie holds in all steps until one releases it")
{
   const std::string steps = Replaced(good, "end = 20\n", "") +
                             "[[step]]\nname = \"press\"\nduration = 10\n"
                             "[[step]]\nname = \"hold\"\nduration = 10\n";
   const std::vector<CaseOfStep> cases =
      CasesOfSteps(ParseCase(steps, "case.toml"));
   REQUIRE(cases.size() == 2);
   CheckGood(cases[1].setup);
   const std::vector<CaseOfStep> released =
      CasesOfSteps(ParseCase(steps + "release = \"glue\"\n", "case.toml"));
   REQUIRE(released.size() == 2);
   CheckGood(released[0].setup);
   CHECK(released[1].setup.ties.empty());
   CHECK_THAT(ErrorOfStack(steps + "release = \"clue\"\n"),
              Contains("step.1.release.0") && Contains("called \"clue\""));
}

TEST_CASE("A run with a tie goes on from a checkpoint")
{
   std::string text = good + "[solver]\ntolerance = 1e-12\n";
   if (GENERATE(false, true))
   {
      text += "[physics]\ndeformation = \"finite\"\n";
      text = Replaced(text, "{E = 0.5", "{model = \"neo_hookean\", E = 0.5");
      text = Replaced(text, "{E = 1.5", "{model = \"neo_hookean\", E = 1.5");
   }
   Run whole(text);
   whole.Step();
   whole.Step();
   const TemporaryDirectory directory;
   const std::string file =
      WriteCheckpoint(directory.Path(), whole.problem.Get(), whole.stepper);
   Run resumed(text);
   ReadCheckpoint(file, resumed.problem.Get(), resumed.stepper);
   for (int step = 2; step < 4; step++)
   {
      const History::Row a = whole.Step();
      const History::Row b = resumed.Step();
      for (const char *column :
           {"t", "tie.glue.force_x", "tie.glue.force_z", "tie.glue.moment_y"})
      {
         CAPTURE(step, column);
         CHECK(ValueIn(b, column) == Approx(ValueIn(a, column)).epsilon(1e-9));
      }
      // Pressures may jump by as much as they are allowed to, and flows are
      // differences of pressures.
      CHECK(ValueIn(b, "fluid.peak_pressure") ==
            Approx(ValueIn(a, "fluid.peak_pressure")).epsilon(1e-7));
      const real_t outflow = ValueIn(a, "fluid.outflow");
      for (const char *column : {"fluid.outflow", "tie.glue.fluid_exchange"})
      {
         CAPTURE(step, column);
         CHECK(std::abs(ValueIn(b, column) - ValueIn(a, column)) <=
               1e-6 * outflow);
      }
   }
   // Another name is another problem.
   Run other(Replaced(text, "name = \"glue\"", "name = \"paste\""));
   CHECK_THROWS_WITH(ReadCheckpoint(file, other.problem.Get(), other.stepper),
                     Contains("ties: glue there, paste here"));
}
