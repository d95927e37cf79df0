// ranks: 1 2
//
// [[joint]] in case files: what it says, what is refused and where, and its
// columns of the history.

#include "support/box_case.hpp"
#include "support/boxes.hpp"
#include "synovia/cases/case_problem.hpp"
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
[[rigid_body]]
name = "femur"
surfaces = "z1"
translation = [0, 0, 0]
rotation = [0, 0, 0]
[[joint]]
name = "knee"
side = "left"
proximal = {body = "femur", origin = [0.5, 0.5, 0.6]}
distal = {body = "tibia", origin = [0.5, 0.5, 0.5], long_axis = [0, 0, 2]}
flexion = {times = [0, 1], values = [0, 0.2]}
lateral = 0.01
[time]
end = 1
step = 0.5
)";

void CheckGood(const CaseFile &setup)
{
   REQUIRE(setup.joints.size() == 1);
   const Joint &knee = setup.joints.front();
   CHECK(knee.name == "knee");
   CHECK(knee.of == JointOf::left);
   CHECK(knee.proximal.body == "femur");
   CHECK(knee.distal.origin == Point3{{0.5, 0.5, 0.5}});
   CHECK(knee.distal.long_axis == Point3{{0.0, 0.0, 2.0}});
   CHECK(knee.distal.flexion_axis == Point3{{1.0, 0.0, 0.0}});
   REQUIRE(knee.prescribed[0]);
   CHECK((*knee.prescribed[0])(0.5) == Approx(0.1));
   REQUIRE(knee.prescribed[3]);
   for (const int k : {1, 2, 4, 5})
   {
      CHECK_FALSE(knee.prescribed[k]);
   }
}
} // namespace

TEST_CASE("A joint of a case file is what it says, also written anew")
{
   const CaseFile setup = ParseCase(good, "case.toml");
   CheckGood(setup);
   std::ostringstream written;
   WriteCase(setup, written);
   CheckGood(ParseCase(written.str(), "written.toml"));
}

TEST_CASE("What contradicts itself about joints is an error at its place")
{
   struct Wrong
   {
      std::string from;
      std::string to;
      std::vector<std::string> texts;
   };
   const Wrong wrong = GENERATE(values<Wrong>({
      {"name = \"knee\"", "name = \"a,b\"", {"joint.0.name", "comma"}},
      {"name = \"knee\"\n", "", {"joint.0", "name", "missing"}},
      {"side = \"left\"",
       "side = \"lift\"",
       {"joint.0.side", "\"right\" or \"left\""}},
      {"{body = \"femur\"",
       "{body = \"femor\"",
       {"joint.0.proximal.body", "did you mean \"femur\"?"}},
      {"{body = \"femur\"",
       "{body = \"tibia\"",
       {"joint.0", "both sides are the rigid body \"tibia\""}},
      {", origin = [0.5, 0.5, 0.6]",
       "",
       {"joint.0.proximal.origin", "missing"}},
      {"long_axis = [0, 0, 2]",
       "long_axis = [1, 0, 0]",
       {"joint.0", "the distal side: its flexion_axis and long_axis"}},
      {"long_axis = [0, 0, 2]",
       "flexion_axis = [0, 0, -1]",
       {"joint.0", "the distal side: its flexion_axis and long_axis"}},
      {"origin = [0.5, 0.5, 0.6]",
       "origin = [0.5, 0.5, 0.6], flexion_axis = [0, 0, 0]",
       {"joint.0", "the proximal side: its flexion_axis and long_axis"}},
      {"origin = [0.5, 0.5, 0.6]",
       "origin = [0.5, 0.5, 0.6], flexion_axis = \"x\"",
       {"joint.0.proximal.flexion_axis: found the string \"x\"",
        "a list of 3 numbers"}},
      {"origin = [0.5, 0.5, 0.6]",
       "origin = [0.5, 0.5]",
       {"joint.0.proximal.origin: found a list of 2"}},
      {"long_axis = [0, 0, 2]",
       "long_axis = 2",
       {"joint.0.distal.long_axis", "a list of 3 numbers"}},
      {"lateral = 0.01",
       "medial = 0.01",
       {"joint.0.medial", "there is no such key"}},
      {"lateral = 0.01", "lateral = \"free\"", {"joint.0.lateral"}},
   }));
   CAPTURE(wrong.from, wrong.to);
   const std::string error = ErrorOf(Replaced(good, wrong.from, wrong.to));
   for (const std::string &part : wrong.texts)
   {
      CHECK_THAT(error, Contains(part));
   }
   CHECK(ErrorOf(good).empty());
}

TEST_CASE("The history has coordinates and drives of each joint")
{
   const CaseFile setup = ParseCase(good, "case.toml");
   NamedMesh mesh = MakeBox(BoxOptions());
   CaseProblem problem(setup, mesh);
   std::ostringstream report;
   ProblemReport(setup, problem).Write(report);
   CHECK_THAT(report.str(), Contains("joints\n") && Contains("knee") &&
                               Contains("left") && Contains("lateral"));
   TimeStepper stepper(problem.Get(), setup.time);
   StepReport step = stepper.Step();
   INFO(step.reason);
   REQUIRE(step.converged);
   step = stepper.Step();
   INFO(step.reason);
   REQUIRE(step.converged);
   const History::Row row = StepDiagnostics(problem.Get(), stepper, step);
   const auto find = [&](const std::string &column)
   {
      return std::find_if(row.begin(), row.end(),
                          [&](const auto &entry)
                          { return entry.first == column; });
   };
   const auto value = [&](const std::string &column)
   {
      INFO(column);
      REQUIRE(find(column) != row.end());
      return find(column)->second;
   };
   CHECK(value("joint.knee.flexion") == Approx(0.2).epsilon(1e-7));
   CHECK(value("joint.knee.lateral") == Approx(0.01).epsilon(1e-7));
   CHECK(std::abs(value("joint.knee.abduction")) < 0.1);
   CHECK(std::abs(value("joint.knee.distraction") - 0.1) < 0.1);
   // As the block resists.
   CHECK(value("joint.knee.flexion_moment") > 1e-3);
   CHECK(value("joint.knee.flexion_moment") ==
         Approx(-value("rigid_body.tibia.moment_x")).epsilon(0.1));
   CHECK(value("joint.knee.lateral_force") > 1e-4);
   CHECK(find("joint.knee.anterior_force") == row.end());
}
