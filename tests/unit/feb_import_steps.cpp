// ranks: 1
//
// Times of FEBio: steps after each other, steady states.

#include "support/feb_column_parts.hpp"
#include "support/feb_text.hpp"
#include "synovia/cases/case_problem.hpp"
#include "synovia/feb/feb_import.hpp"

#include <catch2/catch.hpp>

using namespace mfem;
using namespace synovia;
using namespace synovia::feb_column;

namespace
{
using Fate = FebReport::Fate;
} // namespace

TEST_CASE("Fluid takes no time in a steady state")
{
   const FebImport import = ImportFeb(
      Replaced(FebColumn(), "TRANSIENT", "STEADY-STATE"), "model.feb");
   CHECK_FALSE(import.report.IsStopped());
   CHECK(import.report.Text(Fate::approximated)
            .find("Control/analysis: each step ends in a steady state") !=
         std::string::npos);
   // 2^2 / (H_A 0.01) with H_A about 2 is 200, a step 0.5.
   const PermeabilityCase &permeability =
      import.setup.materials[0].permeability;
   CHECK(permeability.parameters.at("value") == Approx(0.01e6));
   CHECK(permeability.parameters.at("M") == 1.5);
}

TEST_CASE("Steps of a model begin where those before them end")
{
   const std::string control = R"(<Control>
		<analysis>TRANSIENT</analysis>
		<time_steps>10</time_steps>
		<step_size>0.5</step_size>
		<solver type="biphasic"><dtol>0.001</dtol></solver>
	</Control>)";
   std::string text = Replaced(FebColumn(), control, "");
   const std::string load =
      text.substr(text.find("\t<Loads>"),
                  text.find("\t<LoadData>") - text.find("\t<Loads>"));
   text = Replaced(text, load, R"(	<Step>
		<step id="1" name="press">
			<Control><time_steps>4</time_steps><step_size>0.25</step_size></Control>
			<Boundary>
				<bc name="down" node_set="@surface:top" type="prescribed displacement">
					<dof>z</dof><value lc="1">-0.1</value><relative>0</relative>
				</bc>
			</Boundary>
		</step>
		<step id="2" name="creep">
			<Control><time_steps>2</time_steps><step_size>1</step_size></Control>
)" + load + "\t\t</step>\n\t</Step>\n");
   const FebImport import = ImportFeb(text, "model.feb");
   CHECK(import.report.Text(Fate::unsupported) == "");
   CheckCase(import.setup);
   const CaseFile &setup = import.setup;
   CHECK(setup.boundaries.size() == 3);
   REQUIRE(setup.steps.size() == 2);
   CHECK(setup.steps[0].name == "press");
   CHECK(setup.steps[0].duration == 1.0);
   CHECK(setup.steps[1].duration == 2.0);
   CHECK(setup.time.stops == std::vector<real_t>{0.25, 0.5, 0.75, 1.0, 2.0});
   REQUIRE(setup.steps[0].boundaries.size() == 1);
   CHECK((*setup.steps[0].boundaries[0].displacement[2])(0.5) == Approx(-0.1));
   CHECK(setup.steps[1].release ==
         std::vector<std::string>{setup.steps[0].boundaries[0].name});
   REQUIRE(setup.steps[1].boundaries.size() == 1);
   // The curve goes on: its value at t = 1.5 is 2.
   CHECK((*setup.steps[1].boundaries[0].normal_traction)(1.0) == Approx(-1.0));
   const FebImport moved =
      ImportFeb(Replaced(text, "\t\t</step>\n\t</Step>",
                         "<Rigid><rigid_bc/></Rigid></step></Step>"),
                "model.feb");
   CHECK(moved.report.IsStopped());
   // What counts from what there is when a step begins.
   const FebImport relative =
      ImportFeb(Replaced(text, "<relative>0", "<relative>1"), "model.feb");
   CHECK(relative.report.Text(Fate::unsupported) == "");
   CHECK(relative.setup.steps[0].boundaries[0].relative);
}

namespace
{
// The column under a plate that is moved and loaded in two steps.
FebImport PressedInSteps(const std::string &first, const std::string &second)
{
   std::string text = FebPressedColumn();
   const size_t control = text.find("\t<Control>");
   const size_t end = text.find("\t<Globals>");
   text = text.substr(0, control) + text.substr(end);
   const size_t rigid = text.find("\t\t<rigid_load");
   const size_t loaded = text.find("</rigid_load>") + 13;
   text = text.substr(0, rigid) + text.substr(loaded);
   return ImportFeb(Replaced(text, "\t<LoadData>",
                             R"(	<Step>
		<step id="1"><Control><time_steps>4</time_steps>
			<step_size>0.25</step_size></Control><Rigid>)" +
                                first + R"(</Rigid></step>
		<step id="2"><Control><time_steps>2</time_steps>
			<step_size>1</step_size></Control><Rigid>)" +
                                second +
                                "</Rigid></step>\n\t</Step>\n\t<LoadData>"),
                    "model.feb");
}

std::string Moved(const std::string &value, const std::string &relative = "0")
{
   return "<rigid_bc type=\"rigid_displacement\"><rb>plate</rb><dof>z</dof>"
          "<value lc=\"1\">" +
          value + "</value><relative>" + relative + "</relative></rigid_bc>";
}

const std::string held = "<rigid_bc type=\"rigid_fixed\"><rb>plate</rb>"
                         "<Rz_dof>1</Rz_dof></rigid_bc>";
const std::string loaded = "<rigid_load type=\"rigid_force\"><rb>plate</rb>"
                           "<dof>Rz</dof><value lc=\"1\">-0.1</value>"
                           "</rigid_load>";
} // namespace

TEST_CASE("Rigid bodies move from step to step")
{
   const auto steps_of = [](const FebImport &import)
   {
      REQUIRE(import.report.Text(Fate::unsupported) == "");
      CheckCase(import.setup);
      REQUIRE(import.setup.steps.size() == 2);
      return import.setup.steps;
   };
   // lc 1 is 2 from t = 1 on.
   std::vector<StepCase> steps = steps_of(PressedInSteps(Moved("-0.05"), held));
   REQUIRE(steps[1].rigid_bodies.size() == 1);
   CHECK((*steps[0].rigid_bodies[0].translation[2])(0.5) == Approx(-0.05));
   CHECK_FALSE(steps[1].rigid_bodies[0].relative);
   CHECK((*steps[1].rigid_bodies[0].translation[2])(0.5) == Approx(-0.1));
   // What holds in all steps still does.
   CHECK(steps[1].rigid_bodies[0].translation[0]->IsZero());

   steps = steps_of(PressedInSteps(Moved("-0.05"), Moved("-0.02", "1")));
   CHECK((*steps[1].rigid_bodies[0].translation[2])(0.5) == Approx(-0.14));

   // Where the load leaves the plate is not known beforehand.
   steps = steps_of(PressedInSteps(loaded, held));
   CHECK_FALSE(steps[0].rigid_bodies[0].translation[2]);
   CHECK((*steps[0].rigid_bodies[0].force)[2](0.5) == Approx(-0.1));
   CHECK(steps[1].rigid_bodies[0].relative);
   CHECK((*steps[1].rigid_bodies[0].translation[2])(0.5) == 0.0);
   CHECK_FALSE(steps[1].rigid_bodies[0].force);
   CHECK(PressedInSteps(loaded, held + "<rigid_connector type=\"rigid spring\">"
                                       "<body_a>plate</body_a>"
                                       "<body_b>plate</body_b>"
                                       "</rigid_connector>")
            .report.Text(Fate::unsupported)
            .find("only known to be connected in all steps") !=
         std::string::npos);
}

TEST_CASE("Steps of solids have no times of their own")
{
   std::string text = Replaced(FebColumn(), "TRANSIENT", "STATIC");
   CHECK(ImportFeb(text, "model.feb").report.Text(Fate::unsupported) ==
         "  line 5: Control/analysis: found \"STATIC\"; there are TRANSIENT, "
         "STEADY-STATE, and STATIC in the module solid\n");
   const size_t material = text.find("\t\t<material ");
   const size_t end = text.find("\t</Material>");
   text = text.substr(0, material) +
          "<material id=\"1\" name=\"tissue\" type=\"neo-Hookean\"><E>2</E>"
          "<v>0.1</v></material>" +
          text.substr(end);
   text = Replaced(text, "Module type=\"biphasic\"", "Module type=\"solid\"");
   text = Replaced(text, drained, "");
   const FebImport import = ImportFeb(text, "model.feb");
   CHECK(import.report.Text(Fate::unsupported) == "");
   CHECK(import.setup.time.step == 0.5);
   CHECK_FALSE(import.setup.materials[0].HasFluid());
   CheckCase(import.setup);
}

TEST_CASE("What a step adds to all steps stops the import")
{
   const auto stopped = [](const std::string &loads)
   {
      const std::string step =
         "<Step><step><Control><time_steps>4</time_steps><step_size>0.25"
         "</step_size></Control><Loads>" +
         loads + "</Loads></step></Step>";
      return ImportFeb(Replaced(FebColumn(), "<LoadData>", step + "<LoadData>"),
                       "model.feb")
         .report.Text(Fate::unsupported);
   };
   CHECK(stopped("<surface_load surface=\"top\" type=\"pressure\"><pressure>1"
                 "</pressure></surface_load>")
            .find("Step/step/Loads/surface_load: \"top\" has such a condition "
                  "in all steps already") != std::string::npos);
   CHECK(stopped("<body_load type=\"const\"><x>1</x></body_load>")
            .find("body loads are only known in all steps") !=
         std::string::npos);
}
