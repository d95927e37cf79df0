// ranks: 1 2
//
// [[rigid_body]] in case files: what it says, what is refused and where, and
// the columns of the history.

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
surfaces = ["z1"]
reference = [0.5, 0.5, 3]
translation = ["free", 0, {times = [0, 1], values = [0, -0.1]}]
force = [0.01, 0, 0]
moment = [0, {times = [0, 1], values = [0, 0.002]}, 0]
load_follows = true
stiffness = [0.5, 0, 0]
rotational_stiffness = [0, 0, 0.25]
[time]
end = 1
step = 1
)";

void CheckGood(const CaseFile &setup)
{
   REQUIRE(setup.rigid_bodies.size() == 2);
   const RigidBodyOptions tibia = setup.rigid_bodies[0].Options();
   const RigidBodyOptions femur = setup.rigid_bodies[1].Options();
   for (int i = 0; i < 6; i++)
   {
      CHECK_FALSE(tibia.IsFree(i));
      CHECK(femur.IsFree(i) == (i != 1 && i != 2));
   }
   CHECK_FALSE(tibia.reference);
   CHECK(femur.reference == Point3{{0.5, 0.5, 3.0}});
   CHECK((*femur.prescribed[2])(0.5) == Approx(-0.05));
   CHECK(femur.load[0](7.0) == 0.01);
   CHECK(femur.load[4](0.5) == Approx(0.001));
   CHECK(femur.load[5](0.5) == 0.0);
   CHECK(femur.load_follows);
   CHECK(femur.stiffness[0] == 0.5);
   CHECK(femur.stiffness[5] == 0.25);
}
} // namespace

TEST_CASE("A rigid body of a case file has its freedoms, also written anew")
{
   const CaseFile setup = ParseCase(good, "case.toml");
   CheckGood(setup);
   std::ostringstream written;
   WriteCase(setup, written);
   CheckGood(ParseCase(written.str(), "written.toml"));
}

TEST_CASE("What contradicts itself about rigid bodies is an error")
{
   struct Wrong
   {
      std::string from;
      std::string to;
      std::vector<std::string> texts;
   };
   const Wrong wrong = GENERATE(values<Wrong>({
      {"name = \"femur\"",
       "name = \"tibia\"",
       {"rigid_body.1.name", "a rigid body is called \"tibia\" already",
        "give this one another name"}},
      {"name = \"femur\"", "name = \"a/b\"", {"rigid_body.1.name", "no slash"}},
      {"name = \"femur\"\n", "", {"rigid_body.1", "name", "missing"}},
      {"[\"z1\"]", "[]", {"rigid_body.1.surfaces", "name at least one"}},
      {"[\"z1\"]", "[\"top\"]", {"rigid_body.1.surfaces.0", "\"top\""}},
      {"[\"z1\"]",
       "[\"z1\", \"z0\"]",
       {"rigid_body.1.surfaces", "\"z0\" is moved already"}},
      {"[\"z1\"]",
       "[\"y1\"]",
       {"rigid_body", "\"femur\"", "tied to points that another one"}},
      {"surfaces = \"x0\"\n",
       "surfaces = \"z1\"\ndisplacement = [0, \"free\", \"free\"]\n",
       {"rigid_body.1.surfaces", "\"z1\" is moved already",
        "prescribe its displacement"}},
      {"surfaces = \"x0\"\n",
       "surfaces = \"x0\"\ndisplacement = [0, \"free\", \"free\"]\n",
       {"rigid_body", "\"femur\"", "whose displacement is prescribed",
        "is free to move them"}},
      {"force = [0.01, 0, 0]",
       "force = [0, 1, 0]",
       {"rigid_body.1", "the translation along y is prescribed",
        "a force acts on it too"}},
      {"rotation = [0, 0, 0]",
       "rotation = [0, 0, 0]\nmoment = [0, 0, 1]",
       {"rigid_body.0", "the rotation about z is prescribed",
        "a moment acts on it too"}},
      {"stiffness = [0.5, 0, 0]",
       "stiffness = [0, 0, 2]",
       {"rigid_body.1", "the translation along z is prescribed",
        "a spring holds it too"}},
      {"[0, 0, 0.25]",
       "[0, 0, -1]",
       {"rigid_body.1", "the stiffness of the rotation about z is negative"}},
      {"[0, 0, 0.25]",
       "[0, 0.25]",
       {"rigid_body.1.rotational_stiffness: found a list of 2",
        "a list of 3 numbers"}},
      {"rotation = [0, 0, 0]",
       "rotation = [0, 0, 0]\nrotational_stiffness = [1, 0, 0]",
       {"rigid_body.0", "the rotation about x is prescribed",
        "a spring holds it too"}},
      {"rotation = [0, 0, 0]",
       "rotation = 0",
       {"rigid_body.0.rotation: found the integer 0", "a list of 3"}},
      {"rotation = [0, 0, 0]",
       "rotation = [0, 0, \"fre\"]",
       {"rigid_body.0.rotation.2: found the string \"fre\"", "\"free\""}},
      {"translation = [0, 0, 0]",
       "translation = [0, 0]",
       {"rigid_body.0.translation: found a list of 2", "a list of 3"}},
      {"translation = [0, 0, 0]",
       "translation = [0, nan, 0]",
       {"rigid_body.0.translation.1", "finite"}},
      {"{times = [0, 1], values = [0, -0.1]}",
       "{times = [1, 0], values = [0, -0.1]}",
       {"rigid_body.1.translation.2.times.1", "must ascend"}},
      {"force = [0.01, 0, 0]",
       "force = [\"free\", 0, 0]",
       {"rigid_body.1.force.0: found the string \"free\""}},
      {"force = [0.01, 0, 0]",
       "force = 0.01",
       {"rigid_body.1.force: found the number 0.01", "a list of 3"}},
      {"[0.5, 0.5, 3]",
       "[0.5, 3]",
       {"rigid_body.1.reference", "a list of 3 numbers"}},
      {"load_follows = true",
       "load_follows = 1",
       {"rigid_body.1.load_follows", "true or false"}},
      {"load_follows",
       "follows",
       {"rigid_body.1.follows", "there is no such key"}},
      {"solid = {model = \"neo_hookean\"",
       "solid = {model = \"isotropic\"",
       {"its loads follow it", "take finite deformation"}},
   }));
   CAPTURE(wrong.from, wrong.to);
   std::string text = Replaced(good, wrong.from, wrong.to);
   if (wrong.texts[0] == "its loads follow it")
   {
      text = Replaced(text, "deformation = \"finite\"", "");
   }
   const std::string error = ErrorOf(text);
   for (const std::string &part : wrong.texts)
   {
      CHECK_THAT(error, Contains(part));
   }
   CHECK(ErrorOf(good).empty());
}

TEST_CASE("A body that nothing but a free rigid one is tied to is an error")
{
   const std::string free = "translation = [0, 0, 0]\nrotation = [0, 0, 0]\n";
   std::string text = Replaced(good, free, "");
   text = Replaced(text, "stiffness = [0.5, 0, 0]\n", "");
   CHECK_THAT(ErrorOf(text), Contains("rigid_body") &&
                                Contains("nothing holds \"body\"") &&
                                Contains("free to move along x"));
}

TEST_CASE("The report has what moves each rigid body")
{
   const CaseFile setup = ParseCase(good, "case.toml");
   NamedMesh mesh = MakeBox(BoxOptions());
   CaseProblem problem(setup, mesh);
   std::ostringstream report;
   ProblemReport(setup, problem).Write(report);
   const std::string text = report.str();
   CHECK_THAT(text, Contains("rigid bodies\n"));
   CHECK_THAT(text, Contains("(0.5, 0.5, 0)") &&
                       Contains("fixed, fixed, fixed") &&
                       Contains("(0.5, 0.5, 3)") &&
                       Contains("force and spring, fixed, prescribed") &&
                       Contains("free, moment, spring"));
   CHECK_THAT(text, Contains("rigid body, sealed"));
}

TEST_CASE("The history has pose, force and moment of each rigid body")
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
   CHECK(value("rigid_body.femur.translation_z") == Approx(-0.1));
   CHECK(value("rigid_body.femur.translation_y") == 0.0);
   CHECK(value("rigid_body.tibia.translation_z") == 0.0);
   CHECK(value("rigid_body.femur.rotation_y") > 1e-3);
   CHECK(value("rigid_body.femur.force_z") < -1e-3);
   for (const std::string axis : {"x", "y", "z"})
   {
      CHECK(value("rigid_body.femur.force_" + axis) ==
            Approx(-value("rigid_body.tibia.force_" + axis)).margin(1e-9));
   }
   CHECK(value("rigid_body.tibia.moment_y") != 0.0);
}
