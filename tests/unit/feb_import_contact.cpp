// ranks: 1 2
//
// Surfaces of FEBio that are tied, slide, or keep to a plane.

#include "support/feb_text.hpp"
#include "support/temporary_directory.hpp"
#include "synovia/cases/case_problem.hpp"
#include "synovia/cases/case_steps.hpp"
#include "synovia/feb/feb_import.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <fstream>

using namespace mfem;
using namespace synovia;

namespace
{
using Fate = FebReport::Fate;

// The column, of two blocks that are tied.
std::string TiedColumn()
{
   std::string text =
      Replaced(FebColumn(), "\t\t</Nodes>",
               R"(			<node id="13">0,0,1</node>
			<node id="14">1,0,1</node>
			<node id="15">1,1,1</node>
			<node id="16">0,1,1</node>
		</Nodes>)");
   text =
      Replaced(text, "<elem id=\"2\">5,6,7,8,", "<elem id=\"2\">13,14,15,16,");
   text = Replaced(text, "9,10,11,12</NodeSet>",
                   "9,10,11,12,13,14,15,16</NodeSet>");
   text = Replaced(text, "\t\t<Surface name=\"top\">",
                   R"(		<Surface name="low">
			<quad4 id="1">5,6,7,8</quad4>
		</Surface>
		<Surface name="high">
			<quad4 id="1">16,15,14,13</quad4>
		</Surface>
		<SurfacePair name="pair">
			<primary>low</primary><secondary>high</secondary>
		</SurfacePair>
		<Surface name="top">)");
   const std::string contact = R"(	<Contact>
		<contact name="glue" surface_pair="pair" type="tied-biphasic">
			<laugon>PENALTY</laugon><penalty>10</penalty>
			<two_pass>1</two_pass><search_radius>1</search_radius>
		</contact>
	</Contact>
)";
   return Replaced(text, "\t<Loads>", contact + "\t<Loads>");
}
} // namespace

TEST_CASE("Tied surfaces are a tie, in all steps")
{
   const std::string text = TiedColumn();
   for (const std::string type : {"tied-biphasic", "tied-elastic"})
   {
      const FebImport import =
         ImportFeb(Replaced(text, "tied-biphasic", type), "model.feb");
      CHECK(import.report.Text(Fate::unsupported) == "");
      CHECK(import.report.Text(Fate::ignored).find("penalty") !=
            std::string::npos);
      CheckCase(import.setup);
      CHECK(import.setup.contacts.empty());
      REQUIRE(import.setup.ties.size() == 1);
      const TieCase &tie = import.setup.ties[0];
      CHECK(tie.name == "glue");
      CHECK(tie.destination == std::vector<std::string>{"low"});
      CHECK(tie.source == std::vector<std::string>{"high"});
      const TemporaryDirectory directory(MPI_COMM_WORLD);
      const std::string file = directory.Path() + "/model.msh";
      directory.OnRootOnly([&]() { std::ofstream(file) << import.mesh; });
      NamedMesh mesh = ReadGmsh(file, MPI_COMM_WORLD);
      CaseProblem problem(import.setup, mesh);
      CHECK_NOTHROW(problem.Get().Operator());
      CHECK(problem.Get().Bodies().size() == 1);
   }
}

TEST_CASE("A tie of the first step ends with it")
{
   std::string text = TiedColumn();
   const size_t contact = text.find("\t<Contact>");
   const size_t end = text.find("\t<Loads>");
   const std::string tie = text.substr(contact, end - contact);
   text = text.substr(0, contact) + text.substr(end);
   const size_t control = text.find("\t<Control>");
   const size_t globals = text.find("\t<Globals>");
   const std::string times = text.substr(control, globals - control);
   text = text.substr(0, control) + text.substr(globals);
   const auto with = [&](const std::string &first, const std::string &second)
   {
      return ImportFeb(Replaced(text, "\t<LoadData>",
                                "<Step><step>" + times + first +
                                   "</step><step>" + times + second +
                                   "</step></Step>\n\t<LoadData>"),
                       "model.feb");
   };
   const FebImport import = with(tie, "");
   CHECK(import.report.Text(Fate::unsupported) == "");
   REQUIRE(import.setup.ties.size() == 1);
   REQUIRE(import.setup.steps.size() == 2);
   CHECK(import.setup.steps[1].release == std::vector<std::string>{"glue"});
   const std::vector<CaseOfStep> cases = CasesOfSteps(import.setup);
   CHECK(cases[0].setup.ties.size() == 1);
   CHECK(cases[1].setup.ties.empty());
   CHECK(with("", tie)
            .report.Text(Fate::unsupported)
            .find("tied from the first step on") != std::string::npos);
}

TEST_CASE("Solids without fluid slide along each other")
{
   std::string text = FebPressedColumn();
   const size_t begin = text.find("<material id=\"1\"");
   const size_t end = text.find("</material>", begin);
   text = text.substr(0, begin) +
          R"(<material id="1" name="tissue" type="neo-Hookean">
			<density>1</density><E>2</E><v>0.1</v>)" +
          text.substr(end);
   text = Replaced(text, "sliding-biphasic\"/>",
                   "sliding-elastic\"><tension>0</tension>"
                   "<fric_coeff>0.1</fric_coeff><penalty>10</penalty>"
                   "<smooth_aug>0</smooth_aug></contact>");
   const FebImport import = ImportFeb(text, "model.feb");
   CHECK(import.report.Text(Fate::unsupported) == "");
   CheckCase(import.setup);
   REQUIRE(import.setup.contacts.size() == 1);
   const ContactCase &pair = import.setup.contacts[0];
   CHECK(pair.source == std::vector<std::string>{"below"});
   CHECK(pair.destination == std::vector<std::string>{"top"});
   CHECK(pair.options.friction.coefficient == 0.1);
   CHECK_FALSE(import.setup.materials[0].HasFluid());
   const TemporaryDirectory directory(MPI_COMM_WORLD);
   const std::string file = directory.Path() + "/model.msh";
   directory.OnRootOnly([&]() { std::ofstream(file) << import.mesh; });
   NamedMesh mesh = ReadGmsh(file, MPI_COMM_WORLD);
   CaseProblem problem(import.setup, mesh);
   CHECK_NOTHROW(problem.Get().Operator());
   const FebImport wet = ImportFeb(
      Replaced(FebPressedColumn(), "sliding-biphasic", "sliding-elastic"),
      "model.feb");
   CHECK(wet.report.Text(Fate::unsupported).find("sliding-biphasic lets it") !=
         std::string::npos);
}

TEST_CASE("Friction between two surfaces with fluid takes stabilized pressures")
{
   const auto with = [](const std::string &friction)
   {
      const std::string text = Replaced(TiedColumn(), "tied-biphasic\">",
                                        "sliding-biphasic\">" + friction);
      const FebImport import = ImportFeb(text, "model.feb");
      CHECK(import.report.Text(Fate::unsupported) == "");
      REQUIRE(import.setup.contacts.size() == 1);
      const bool stabilized = import.setup.space.stabilization == 1.0;
      CHECK((stabilized || import.setup.space.stabilization == 0.0));
      CHECK(stabilized ==
            (import.report.Text(Fate::approximated).find("stabilized") !=
             std::string::npos));
      return stabilized;
   };
   CHECK_FALSE(with(""));
   CHECK(with("<fric_coeff>0.1</fric_coeff>"));
   CHECK_FALSE(with("<fric_coeff>0.1</fric_coeff>"
                    "<contact_frac>1</contact_frac>"));
}

TEST_CASE("Contact that bears tension along a plane is a guide")
{
   const FebImport import = ImportFeb(FebGuidedColumn(), "model.feb");
   CHECK(import.report.Text(Fate::unsupported) == "");
   CHECK(import.setup.contacts.empty());
   CHECK(import.setup.rigid_bodies.empty());
   REQUIRE(import.setup.boundaries.size() == 5);
   const BoundaryCase &guided = import.setup.boundaries.back();
   CHECK(guided.surfaces == std::vector<std::string>{"side"});
   REQUIRE(guided.guide.has_value());
   CHECK(std::abs((*guided.guide)[0]) == Approx(1.0));
   CHECK_THAT(import.report.Text(Fate::ignored),
              Catch::Matchers::Contains("hold its nodes likewise"));

   const auto stops = [](const std::string &old, const std::string &other)
   {
      return ImportFeb(Replaced(FebGuidedColumn(), old, other), "model.feb")
         .report.Text(Fate::unsupported);
   };
   CHECK_THAT(stops("<Rx_dof>1</Rx_dof>", ""),
              Catch::Matchers::Contains("only where the rigid body is fixed"));
   CHECK_THAT(stops("<node id=\"23\">1,", "<node id=\"23\">1.5,"),
              Catch::Matchers::Contains("only along a plane"));
   // Nothing else holds the edge along z.
   CHECK_THAT(stops("<x_dof>1</x_dof><y_dof>1</y_dof>", "<z_dof>1</z_dof>"),
              Catch::Matchers::Contains("conditions go with surfaces"));
}
