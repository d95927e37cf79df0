// ranks: 1 2
//
// [[ligament]] in case files: what it says, what is refused and where, its row
// in the report and its columns of the history.

#include "support/box_case.hpp"
#include "support/boxes.hpp"
#include "synovia/cases/case_problem.hpp"
#include "synovia/cases/case_steps.hpp"
#include "synovia/general/error.hpp"
#include "synovia/io/step_diagnostics.hpp"
#include "synovia/runs/problem_report.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <sstream>

using namespace mfem;
using namespace synovia;
using Catch::Matchers::Contains;

namespace
{
const std::string good = R"([mesh]
file = "box.msh"
[space]
order = 1
[physics]
deformation = "finite"
[[material]]
regions = "body"
solid = {model = "neo_hookean", E = 0.5, nu = 0.1}
permeability = {value = 4e-3}
[[boundary]]
surfaces = "x0"
pressure = 0
[[rigid_body]]
name = "tibia"
surfaces = "z0"
translation = [0, 0, 0]
rotation = [0, 0, 0]
[[rigid_body]]
name = "femur"
surfaces = "z1"
force = [0, 0, 0.01]
[[ligament]]
name = "medial"
from = {body = "femur", point = [1.2, 0.5, 1.1]}
to = {body = "tibia", point = [1.2, 0.5, 0]}
strain_stiffness = 0.2
prestrain = 0.1
toe_strain = 0.06
[[ligament]]
name = "post"
from = {point = [0.5, 0.5, 3]}
to = {body = "femur", point = [0.5, 0.5, 1]}
stiffness = 0.05
slack_length = 2.5
compression = true
[time]
end = 1
step = 1
)";

void CheckGood(const CaseFile &setup)
{
   REQUIRE(setup.ligaments.size() == 2);
   const Ligament &medial = setup.ligaments[0];
   CHECK(medial.name == "medial");
   CHECK(medial.from.body == "femur");
   CHECK(medial.to.point == Point3{{1.2, 0.5, 0.0}});
   CHECK(medial.options.strain_stiffness == 0.2);
   CHECK(medial.options.toe_strain == 0.06);
   CHECK_FALSE(medial.options.compression);
   CHECK(LigamentLaw(medial).SlackLength() == Approx(1.0));
   const Ligament &post = setup.ligaments[1];
   CHECK(post.from.body.empty());
   CHECK(post.options.compression);
   CHECK(LigamentLaw(post).Force(2.0) == Approx(-0.025));
}
} // namespace

TEST_CASE("A ligament of a case file is what it says, also written anew")
{
   const CaseFile setup = ParseCase(good, "case.toml");
   CheckGood(setup);
   std::ostringstream written;
   WriteCase(setup, written);
   CheckGood(ParseCase(written.str(), "written.toml"));
}

TEST_CASE("What contradicts itself about ligaments is an error at its place")
{
   struct Wrong
   {
      std::string from;
      std::string to;
      std::vector<std::string> texts;
   };
   const Wrong wrong = GENERATE(values<Wrong>({
      {"name = \"post\"",
       "name = \"medial\"",
       {"ligament.1.name", "a ligament is called \"medial\" already"}},
      {"name = \"post\"", "name = \"a/b\"", {"ligament.1.name", "no slash"}},
      {"name = \"post\"\n", "", {"ligament.1", "name", "missing"}},
      {"{body = \"femur\", point = [1.2",
       "{body = \"femor\", point = [1.2",
       {"case.toml:25", "ligament.0.from.body",
        "there is no rigid body \"femor\"; did you mean \"femur\"?"}},
      {"{body = \"tibia\", point = [1.2",
       "{body = \"femur\", point = [1.2",
       {"ligament.0", "both ends are attached to \"femur\""}},
      {"to = {body = \"femur\"",
       "to = {body = \"\"",
       {"ligament.1", "both ends are points of space"}},
      {"from = {point = [0.5, 0.5, 3]}\n",
       "",
       {"ligament.1.from.point", "missing"}},
      {"point = [0.5, 0.5, 3]",
       "point = [0.5, 0.5]",
       {"ligament.1.from.point", "a list of 3 numbers"}},
      {"point = [0.5, 0.5, 3]",
       "point = [0.5, 0.5, 1]",
       {"ligament.1", "both ends are at the same point"}},
      {"stiffness = 0.05",
       "stiffness = -0.05",
       {"ligament.1.stiffness", "-0.05", "at least 0"}},
      {"stiffness = 0.05\n", "", {"ligament.1", "give one of stiffness"}},
      {"stiffness = 0.05",
       "strain_stiffness = 1\nstiffness = 0.05",
       {"ligament.1", "give one of stiffness"}},
      {"slack_length = 2.5",
       "slack_length = 2.5\nprestrain = 0.1",
       {"ligament.1", "give one of them"}},
      {"slack_length = 2.5",
       "slack_length = -1",
       {"ligament.1.slack_length", "must be positive, or \"auto\""}},
      {"prestrain = 0.1",
       "prestrain = -1",
       {"ligament.0.prestrain", "above -1"}},
      {"toe_strain = 0.06",
       "toe_strain = -0.06",
       {"ligament.0.toe_strain", "at least 0"}},
      {"toe_strain = 0.06",
       "toe_strain = 0.06\ncompression = true",
       {"ligament.0", "a toe region is one of tension"}},
      {"toe_strain", "toe", {"ligament.0.toe", "there is no such key"}},
   }));
   CAPTURE(wrong.from, wrong.to);
   const std::string error = ErrorOf(Replaced(good, wrong.from, wrong.to));
   for (const std::string &part : wrong.texts)
   {
      CHECK_THAT(error, Contains(part));
   }
   CHECK(ErrorOf(good).empty());
}

TEST_CASE("A body that only ligaments hold may be set up")
{
   // Of the tibia, which a force moves, and the femur, nothing is prescribed.
   std::string text =
      Replaced(good, "translation = [0, 0, 0]\nrotation = [0, 0, 0]\n", "");
   CHECK_THAT(ErrorOf(text),
              Contains("rigid_body") && Contains("nothing holds \"body\""));
   for (const std::string corner : {"0, 0", "1, 0", "0, 1"})
   {
      text += "[[ligament]]\nname = \"to " + std::to_string(text.size()) +
              "\"\nfrom = {point = [" + corner +
              ", -1]}\nto = {body = \"tibia\", point = [" + corner +
              ", 0]}\nstiffness = 1\n";
   }
   CHECK(ErrorOf(text).empty());
}

TEST_CASE("A step may release a ligament")
{
   const std::string steps = Replaced(good, "end = 1\n", "") +
                             "[[step]]\nname = \"whole\"\nduration = 1\n"
                             "[[step]]\nname = \"torn\"\nduration = 1\n"
                             "release = \"medial\"\n";
   const std::vector<CaseOfStep> cases =
      CasesOfSteps(ParseCase(steps, "case.toml"));
   REQUIRE(cases.size() == 2);
   CHECK(cases[0].setup.ligaments.size() == 2);
   REQUIRE(cases[1].setup.ligaments.size() == 1);
   CHECK(cases[1].setup.ligaments[0].name == "post");
   CHECK_THAT(
      ErrorOf(Replaced(steps, "release = \"medial\"", "release = \"lateral\"")),
      Contains("step.1.release.0") &&
         Contains("no boundary, ligament, contact pair or tie that holds"));
}

TEST_CASE("The report has what ligaments join and how long they are")
{
   const CaseFile setup = ParseCase(good, "case.toml");
   NamedMesh mesh = MakeBox(BoxOptions());
   CaseProblem problem(setup, mesh);
   std::ostringstream report;
   ProblemReport(setup, problem).Write(report);
   const std::string text = report.str();
   CHECK_THAT(text, Contains("ligaments\n") && Contains("force per strain"));
   const auto row = [&](const std::string &name)
   {
      const size_t at = text.find(name, text.find("ligaments\n"));
      REQUIRE(at != std::string::npos);
      return text.substr(at, text.find('\n', at) - at);
   };
   CHECK_THAT(row("medial"), Contains("femur") && Contains("tibia") &&
                                Contains("tension, toe region") &&
                                Contains("1.1") && Contains("0.014"));
   CHECK_THAT(row("post"), Contains("space") && Contains("spring") &&
                              Contains("2.5") && Contains("-0.025"));
}

TEST_CASE("The history has length and force of each ligament")
{
   const CaseFile setup = ParseCase(good, "case.toml");
   NamedMesh mesh = MakeBox(BoxOptions());
   CaseProblem problem(setup, mesh);
   TimeStepper stepper(problem.Get(), setup.time);
   const StepReport report = stepper.Step();
   INFO(report.reason);
   REQUIRE(report.converged);
   const History::Row row = StepDiagnostics(problem.Get(), stepper, report);
   const auto value = [&](const std::string &column)
   {
      const auto found =
         std::find_if(row.begin(), row.end(),
                      [&](const auto &entry) { return entry.first == column; });
      INFO(column);
      REQUIRE(found != row.end());
      return found->second;
   };
   const real_t length = value("ligament.post.length");
   CHECK(length > 1.9);
   CHECK(length < 2.1);
   CHECK(value("ligament.post.force") == Approx(0.05 * (length - 2.5)));
   const real_t strain = value("ligament.medial.length") - 1.0;
   CHECK(strain > 0.03);
   CHECK(strain < 0.06);
   CHECK(value("ligament.medial.force") ==
         Approx(0.2 * strain * strain / 0.12));
}
