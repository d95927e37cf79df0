// [[step]] in case files: what holds when, what is refused and where, and that
// it is written as it was understood.

#include "support/boxes.hpp"
#include "synovia/cases/case_difference.hpp"
#include "synovia/cases/case_steps.hpp"
#include "synovia/general/error.hpp"
#include "synovia/runs/step_sequence.hpp"
#include "synovia/runs/step_table.hpp"

#include <catch2/catch.hpp>

#include <sstream>

using namespace mfem;
using namespace synovia;
using Catch::Matchers::Contains;

namespace
{
// Lines are counted in what is checked below.
const std::string good = R"([mesh]
file = "stack.msh"
[[material]]
regions = ["lower", "upper"]
solid = {model = "isotropic", E = 0.5, nu = 0.1}
permeability = {value = 4e-3}
[[boundary]]
surfaces = "lower_z0"
displacement = [0, 0, 0]
[[boundary]]
name = "sides"
surfaces = ["upper_x0", "upper_y0"]
pressure = 0
[[boundary]]
name = "plate"
surfaces = "upper_z1"
displacement = [0, 0, {times = [0, 10], values = [0, -0.1]}]
[[contact]]
name = "joint"
source = "upper_z0"
destination = "lower_z1"
[time]
step = 2
adaptive = true
[[step]]
name = "press"
duration = 10
[[step]]
name = "hold"
duration = 90
step = 9
growth = 1.5
adaptive = false
release = "sides"
[[step]]
name = "slide"
duration = 20
max_step = 4
[[step.boundary]]
name = "plate"
relative = true
displacement = [{times = [0, 20], values = [0, 1]}, 0, 0]
[[step.boundary]]
surfaces = "upper_x1"
normal_traction = {times = [5, 6], values = [0, 1]}
)";

std::string Replaced(std::string text, const std::string &from,
                     const std::string &to)
{
   const size_t at = text.find(from);
   REQUIRE(at != std::string::npos);
   return text.replace(at, from.size(), to);
}

std::string ErrorOf(const std::string &text)
{
   try
   {
      const CaseFile setup = ParseCase(text, "case.toml");
      BoxOptions box;
      NamedMesh mesh = MakeStack(box, box);
      StepSequence sequence(setup, mesh);
   }
   catch (const Error &error)
   {
      return error.what();
   }
   return "";
}

void CheckGood(const CaseFile &setup)
{
   CHECK(setup.time.end == 120.0);
   const std::vector<CaseOfStep> steps = CasesOfSteps(setup);
   REQUIRE(steps.size() == 3);
   const CaseFile &press = steps[0].setup;
   const CaseFile &hold = steps[1].setup;
   const CaseFile &slide = steps[2].setup;
   CHECK(steps[1].name == "hold");
   CHECK(steps[1].begin == 10.0);
   CHECK(steps[1].end == 100.0);
   CHECK(steps[2].end == 120.0);
   CHECK(press.boundaries.size() == 3);
   CHECK(hold.boundaries.size() == 2);
   CHECK(slide.boundaries.size() == 3);
   CHECK(slide.contacts.size() == 1);
   for (const CaseOfStep &step : steps)
   {
      CHECK(step.setup.steps.empty());
      CHECK(step.setup.time.end == 120.0);
   }

   CHECK(press.time.adaptive);
   CHECK(press.time.step == 2.0);
   CHECK(press.time.max_step == 2.0);
   CHECK_FALSE(hold.time.adaptive);
   CHECK(hold.time.step == 9.0);
   CHECK(hold.time.growth == 1.5);
   CHECK(hold.time.max_step == 9.0);
   CHECK(slide.time.growth == 1.0);
   CHECK(slide.time.adaptive);
   CHECK(slide.time.max_step == 4.0);

   // What isn't named stays, and what is takes the place of what was, on the
   // same surfaces.
   const BoundaryCase &held = hold.boundaries[1];
   CHECK(held.name == "plate");
   CHECK_FALSE(held.relative);
   CHECK((*held.displacement[2])(5.0) == -0.05);
   const BoundaryCase &plate = slide.boundaries[1];
   CHECK(plate.name == "plate");
   CHECK(plate.surfaces == std::vector<std::string>{"upper_z1"});
   CHECK(plate.relative);
   CHECK(plate.begin == 100.0);
   // Times count from the beginning of the step.
   CHECK((*plate.displacement[0])(100.0) == 0.0);
   CHECK((*plate.displacement[0])(110.0) == 0.5);
   const BoundaryCase &side = slide.boundaries[2];
   CHECK((*side.normal_traction)(105.5) == 0.5);
   CHECK((*side.normal_traction)(105.0) == 0.0);
}
} // namespace

TEST_CASE("A case says what holds in each step, and is written as it reads")
{
   const CaseFile setup = ParseCase(good, "case.toml");
   CheckGood(setup);
   std::ostringstream written;
   WriteCase(setup, written);
   const CaseFile again = ParseCase(written.str(), "written.toml");
   CheckGood(again);
   std::ostringstream rewritten;
   WriteCase(again, rewritten);
   CHECK(written.str() == rewritten.str());
   CHECK(ErrorOf(good) == "");

   std::ostringstream table;
   WriteSteps(setup, table);
   CHECK_THAT(table.str(), Contains("steps\n") && Contains("2, adaptive") &&
                              Contains("without sides") &&
                              Contains("plate, upper_x1"));
}

TEST_CASE("Keys of steps are overridden by name")
{
   const CaseFile setup =
      ParseCase(good, "case.toml",
                {"step.hold.duration=40", "step.slide.boundary.plate.relative="
                                          "false"});
   CHECK(setup.steps[1].duration == 40.0);
   CHECK(setup.time.end == 70.0);
   CHECK_FALSE(setup.steps[2].boundaries[0].relative);
}

TEST_CASE("A run may be resumed with other time steps in its steps, not with "
          "other steps")
{
   const CaseFile setup = ParseCase(good, "case.toml");
   const auto changes = [&](const std::string &assignment)
   { return FindChanges(setup, ParseCase(good, "", {assignment})); };
   const std::vector<CaseChange> step = changes("step.hold.step=3");
   REQUIRE(step.size() == 1);
   CHECK(step[0].path == "step.1.step");
   CHECK(MayChange(step[0]));
   const std::vector<CaseChange> duration = changes("step.hold.duration=45");
   REQUIRE(duration.size() == 2);
   CHECK((!MayChange(duration[0]) || !MayChange(duration[1])));
}

TEST_CASE("Errors of steps say where, and in which step")
{
   struct Wrong
   {
      std::string from;
      std::string to;
      std::string message;
   };
   const Wrong wrong = GENERATE(
      Wrong{
         "release = \"sides\"", "release = \"side\"",
         "case.toml:34:11: step.1.release.0: no boundary, ligament, contact "
         "pair or tie that holds is called \"side\"; did you mean \"sides\"?"},
      Wrong{"name = \"slide\"\nduration = 20\n",
            "name = \"slide\"\nduration = 20\nrelease = [\"sides\"]\n",
            "step.2.release.0: no boundary, ligament, contact pair or tie that "
            "holds is called \"sides\""},
      Wrong{"name = \"plate\"\nrelative", "name = \"plates\"\nrelative",
            "step.2.boundary.0.surfaces: this is missing, as no boundary that "
            "holds is called \"plates\"; did you mean \"plate\"?"},
      Wrong{"name = \"plate\"\nrelative",
            "name = \"second\"\nsurfaces = \"upper_z1\"\nrelative",
            "in the step \"slide\": displacement, traction or force along x "
            "on \"upper_z1\" is prescribed already"},
      Wrong{"displacement = [{times = [0, 20], values = [0, 1]}, 0, 0]",
            "pressure = 1",
            "in the step \"slide\": no displacement is prescribed here"},
      Wrong{"surfaces = \"upper_x1\"\n",
            "surfaces = \"lower_z1\"\n"
            "pressure = 0\n",
            "in the step \"slide\": the fluid on \"lower_z1\" is the contact "
            "pair's"},
      Wrong{"surfaces = \"upper_x1\"\n", "surfaces = \"upper_x9\"\n",
            "in the step \"slide\""},
      Wrong{"name = \"slide\"", "name = \"hold\"",
            "step.2.name: a step is called \"hold\" already (case.toml:29:8: "
            "step.1.name)"},
      Wrong{"name = \"slide\"", "name = \"a/b\"",
            "step.2.name: found the name \"a/b\""},
      Wrong{"name = \"sides\"", "name = \"plate\"",
            "boundary.2.name: a boundary is called \"plate\" already"},
      Wrong{"duration = 90", "duration = -90",
            "case.toml:30:12: step.1.duration: the duration is -90; it must "
            "be positive"},
      Wrong{"duration = 90\n", "", "step.1.duration: this is missing"},
      Wrong{"duration = 90", "duration = 1e9",
            "step.1.step: the duration of 1e+09 would take"},
      Wrong{"max_step = 4", "max_step = 1",
            "step.2.max_step: found 1; it must be at least the time step, 2"},
      Wrong{"growth = 1.5", "growth = 0.5",
            "step.1.growth: found 0.5; it must be at least 1"},
      Wrong{"max_step = 4", "growth = 1.5",
            "step.2.growth: adaptive steps have lengths of their own"},
      Wrong{"step = 2\n", "step = 2\nend = 100\n",
            "time.end: found 100, but the steps end at 120; leave this out"},
      Wrong{"max_step = 4", "scheme = \"sdirk33\"",
            "step.2.scheme: there is no such key"},
      Wrong{"max_step = 4\n",
            "max_step = 4\n[[step.rigid_body]]\nname = \"femur\"\n",
            "step.2.rigid_body.0.name: there is no rigid body \"femur\""});
   CAPTURE(wrong.to);
   CHECK_THAT(ErrorOf(Replaced(good, wrong.from, wrong.to)),
              Contains(wrong.message));
}

TEST_CASE("A body's motion is relative where it is prescribed")
{
   const std::string body = "[[rigid_body]]\nname = \"block\"\n"
                            "surfaces = \"lower_z0\"\n";
   // In place of the first boundary.
   const std::string text = Replaced(
      good, "[[boundary]]\nsurfaces = \"lower_z0\"\ndisplacement = [0, 0, 0]\n",
      body + "translation = [0, 0, 0]\nrotation = [0, 0, 0]\n");
   const auto said = [&](const std::string &lines)
   {
      return ErrorOf(Replaced(text, "max_step = 4\n",
                              "max_step = 4\n[[step.rigid_body]]\n"
                              "name = \"block\"\n" +
                                 lines));
   };
   const std::string moved =
      "translation = [0, 0, {times = [0, 20], values = [0, 0.1]}]\n"
      "rotation = [0, 0, 0]\n";
   CHECK(said("relative = true\n" + moved) == "");
   CHECK_THAT(said("relative = true\n"),
              Contains(".relative: in the step \"slide\": no freedom is "
                       "prescribed here"));
   CHECK_THAT(said("relative = true\nforce = [0, 0, 1]\n"),
              Contains(".relative: in the step \"slide\": no freedom is "
                       "prescribed here"));
   CHECK_THAT(said("relative = [0, 0, 1]\n" + moved),
              Contains("step.2.rigid_body.0.relative: found a list of 3; "
                       "expected true or false"));
   CHECK_THAT(ErrorOf(Replaced(text, body, body + "relative = true\n")),
              Contains("rigid_body.0.relative: there is no such key"));
}

TEST_CASE("A body that nothing holds in a later step is an error before the "
          "first one")
{
   const std::string text =
      Replaced(Replaced(good, "[{times = [0, 20], values = [0, 1]}, 0, 0]",
                        "[\"free\", \"free\", 0]"),
               "max_step = 4\n", "max_step = 4\nrelease = \"joint\"\n");
   const std::string said = ErrorOf(text);
   CHECK_THAT(said, Contains("nothing holds \"upper\" along x") &&
                       Contains("in the step \"slide\""));
}

TEST_CASE("Without steps the end is required, and with them it isn't")
{
   const size_t steps = good.find("[[step]]");
   CHECK_THAT(ErrorOf(good.substr(0, steps)),
              Contains("time.end: this is missing"));
   CHECK(ErrorOf(Replaced(good, "step = 2\n", "step = 2\nend = 120\n")) == "");
}
