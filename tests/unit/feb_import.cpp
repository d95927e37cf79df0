// ranks: 1 2
//
// Models of FEBio: what a small one becomes, as case and as mesh; each thing
// that isn't known is named with its line and path, and stops the import.

#include "synovia/feb/feb_import.hpp"
#include "support/feb_text.hpp"
#include "support/temporary_directory.hpp"
#include "synovia/cases/case_problem.hpp"
#include "synovia/general/error.hpp"

#include <catch2/catch.hpp>

#include <fstream>

using namespace mfem;
using namespace synovia;

namespace
{
using Fate = FebReport::Fate;

// What stops the import of the column with @a old replaced.
std::string Stopped(const std::string &old, const std::string &other)
{
   const std::string text = Replaced(FebColumn(), old, other);
   const FebImport import = ImportFeb(text, "model.feb");
   CHECK(import.report.IsStopped());
   return import.report.Text(Fate::unsupported);
}

// A line of the report.
std::string Entry(int line, const std::string &text)
{
   return "  line " + std::to_string(line) + ": " + text + "\n";
}
} // namespace

TEST_CASE("A column of FEBio becomes a case")
{
   const FebImport import = ImportFeb(FebColumn(), "some/column.feb");
   CHECK(import.report.Text(Fate::unsupported) == "");
   CHECK(import.report.Text(Fate::approximated) == "");
   CHECK(import.report.Text(Fate::ignored)
            .find(Entry(8, "Control/solver: Newton's method has its own "
                           "settings here")) != std::string::npos);
   const CaseFile &setup = import.setup;
   CHECK(setup.mesh.file == "column.msh");
   CHECK(setup.space.order == 1);
   CHECK(setup.space.deformation == Deformation::finite);
   CHECK(setup.time.end == 5.0);
   CHECK(setup.time.step == 0.5);
   CHECK(setup.time.stops.empty());

   REQUIRE(setup.materials.size() == 1);
   const MaterialCase &material = setup.materials[0];
   CHECK(material.regions == std::vector<std::string>{"body"});
   CHECK(material.solid_fraction == 0.3);
   CHECK(material.solid.model == "neo_hookean");
   CHECK(material.solid.parameters.at("E") == 2.0);
   CHECK(material.solid.parameters.at("nu") == 0.1);
   CHECK(material.permeability.model == "holmes_mow");
   CHECK(material.permeability.parameters.at("value") == 0.01);
   CHECK(material.permeability.parameters.at("M") == 1.5);
   CHECK(material.permeability.parameters.at("alpha") == 2.0);

   REQUIRE(setup.boundaries.size() == 4);
   const auto &boundaries = setup.boundaries;
   CHECK(boundaries[0].surfaces == std::vector<std::string>{"all"});
   CHECK(boundaries[0].displacement[0].has_value());
   CHECK(boundaries[0].displacement[1].has_value());
   CHECK_FALSE(boundaries[0].displacement[2].has_value());
   CHECK(boundaries[1].surfaces == std::vector<std::string>{"bottom"});
   CHECK(boundaries[1].displacement[2].has_value());
   CHECK(boundaries[2].surfaces == std::vector<std::string>{"top"});
   REQUIRE(boundaries[2].pressure.has_value());
   CHECK((*boundaries[2].pressure)(1.0) == 0.0);
   REQUIRE(boundaries[3].normal_traction.has_value());
   CHECK((*boundaries[3].normal_traction)(0.5) == -0.5);
   CHECK((*boundaries[3].normal_traction)(4.0) == -1.0);
}

namespace
{
// The same column in a former format: each pair is replaced.
std::string
Former(const std::vector<std::pair<std::string, std::string>> &changes)
{
   std::string text = FebColumn();
   for (const auto &[old, other] : changes)
   {
      text = Replaced(text, old, other);
   }
   return text;
}

const char *const fixed_sides =
   R"(<bc name="sides" node_set="all" type="zero displacement">
			<x_dof>1</x_dof>
			<y_dof>1</y_dof>
			<z_dof>0</z_dof>
		</bc>)";
const char *const fixed_bottom =
   R"(<bc name="support" node_set="bottom" type="zero displacement">
			<x_dof>0</x_dof>
			<y_dof>0</y_dof>
			<z_dof>1</z_dof>
		</bc>)";
const char *const drained =
   R"(<bc name="drained" node_set="@surface:top" type="zero fluid pressure"/>)";
const char *const bottom_nodes = R"(<NodeSet name="bottom">1,2,3,4</NodeSet>)";
const char *const top_nodes =
   R"(<NodeSet name="lid"><n id="9"/><n id="10"/><n id="11"/><n id="12"/>
		</NodeSet>)";

void CheckAsColumn(const std::string &text)
{
   const FebImport import = ImportFeb(text, "column.feb");
   CHECK(import.report.Text(Fate::unsupported) == "");
   const FebImport other = ImportFeb(FebColumn(), "column.feb");
   REQUIRE(import.setup.boundaries.size() >= 4);
   bool held[3] = {false, false, false};
   bool pressed = false;
   bool loaded = false;
   for (const BoundaryCase &boundary : import.setup.boundaries)
   {
      for (int d = 0; d < 3; d++)
      {
         held[d] = held[d] || boundary.displacement[d].has_value();
      }
      pressed = pressed || (boundary.pressure.has_value() &&
                            boundary.surfaces[0] == "lid");
      loaded = loaded || (boundary.normal_traction.has_value() &&
                          (*boundary.normal_traction)(1.0) == -1.0);
   }
   CHECK(held[0]);
   CHECK(held[1]);
   CHECK(held[2]);
   CHECK(pressed);
   CHECK(loaded);
   CHECK(import.setup.time.end == 5.0);
   CHECK(import.setup.materials[0].regions == other.setup.materials[0].regions);
}
} // namespace

TEST_CASE("Formats 3.0 and 2.5 say the same in other words")
{
   CheckAsColumn(
      Former({{"version=\"4.0\"", "version=\"3.0\""},
              {fixed_sides, R"(<bc name="sides" node_set="all" type="fix">
			<dofs>x,y</dofs></bc>)"},
              {fixed_bottom, R"(<bc name="support" node_set="bottom" type="fix">
			<dofs>z</dofs></bc>)"},
              {drained, R"(<bc name="drained" node_set="lid" type="prescribe">
			<dof>p</dof><scale>0</scale><relative>0</relative></bc>)"},
              {bottom_nodes, std::string(bottom_nodes) + top_nodes}}));
   CheckAsColumn(Former(
      {{"version=\"4.0\"", "version=\"2.5\""},
       {"<analysis>TRANSIENT</analysis>", "<analysis type=\"transient\"/>"},
       {"<solver type=\"biphasic\"><dtol>0.001</dtol></solver>",
        "<dtol>0.001</dtol><max_refs>15</max_refs>"},
       {"<Mesh>", "<Geometry>"},
       {"</Mesh>", "</Geometry>"},
       {"<Elements type=\"hex8\" name=\"body\">",
        "<Elements type=\"hex8\" mat=\"1\" name=\"body\">"},
       {"<MeshDomains>\n\t\t<SolidDomain name=\"body\" "
        "mat=\"tissue\"/>\n\t</MeshDomains>",
        ""},
       {fixed_sides, "<fix bc=\"x,y\" node_set=\"all\"/>"},
       {fixed_bottom, "<fix bc=\"z\" node_set=\"bottom\"/>"},
       {drained, R"(<prescribe bc="p" node_set="lid">
			<scale lc="2">1</scale></prescribe>)"},
       {bottom_nodes, std::string(bottom_nodes) + top_nodes},
       {"<load_controller id=\"1\" type=\"loadcurve\">",
        "<loadcurve id=\"2\"><point>0,0</point></loadcurve>"
        "<loadcurve id=\"1\" type=\"linear\">"},
       {"</load_controller>", "</loadcurve>"}}));
}

TEST_CASE("A column of FEBio becomes a mesh")
{
   const FebImport import = ImportFeb(FebColumn(), "column.feb");
   const TemporaryDirectory directory(MPI_COMM_WORLD);
   const std::string file = directory.Path() + "/column.msh";
   directory.OnRootOnly([&]() { std::ofstream(file) << import.mesh; });
   const NamedMesh mesh = ReadGmsh(file, MPI_COMM_WORLD);
   CHECK(mesh.Get().GetGlobalNE() == 2);
   CHECK(mesh.Region("body").Size() == 1);
   // The faces of a surface may be in others, too.
   for (const char *name : {"all", "bottom", "top"})
   {
      CHECK(mesh.Boundary(name).Size() > 0);
   }
   CHECK(mesh.Boundary("all").Size() == 3);
   CHECK(mesh.Boundary("bottom").Size() == 1);
}

TEST_CASE("What is not known in a model stops its import, with line and path")
{
   const std::string text = FebColumn();
   const auto line = [&](const std::string &part)
   { return LineOf(text, part); };

   // Elements and attributes that nobody asks for.
   CHECK(Stopped("<Output>", "<Growth><rate>1</rate></Growth><Output>") ==
         Entry(line("<Output>"), "Growth: this is not known"));
   CHECK(Stopped("<x_dof>1", "<w_dof>1</w_dof><x_dof>1") ==
         Entry(line("<x_dof>1"), "Boundary/bc/w_dof: this is not known"));
   CHECK(Stopped("<E>2", "<E lc=\"1\">2") ==
         Entry(line("<E>2"), "Material/material/solid/E: the attribute "
                             "lc=\"1\" is not known"));

   // Wrong and missing values.
   CHECK(Stopped("<E>2", "<E>two") ==
         Entry(line("<E>2"), "Material/material/solid/E: found \"two\"; it "
                             "must be a number"));
   CHECK(Stopped("<E>2", "<E>-2").find("Young's modulus") != std::string::npos);
   CHECK(Stopped("<v>0.1</v>", "") ==
         Entry(line("<solid type"), "Material/material/solid: <v> is missing"));
   CHECK(Stopped("\"neo-Hookean\"", "\"Fung\"")
            .find(Entry(line("<solid type"), "Material/material/solid: "
                                             "\"Fung\" is not known; there "
                                             "are solid mixture, neo-Hookean")
                     .substr(0, 60)) == 0);
   CHECK(Stopped("lc=\"1\"", "lc=\"7\"") ==
         Entry(line("lc=\"1\""), "Loads/surface_load/traction: there is no "
                                 "load controller 7"));

   // The mesh.
   CHECK(Stopped("1,2,3,4,5,6,7,8</elem>", "1,2,3,4,5,6,7</elem>")
            .find(Entry(line("<elem id=\"1\""), "Mesh/Elements/elem: found 7 "
                                                "nodes; hex8 has 8")) == 0);
   CHECK(Stopped("1,2,3,4,5,6,7,8</elem>", "1,2,3,4,5,6,7,99</elem>")
            .find(Entry(line("<elem id=\"1\""),
                        "Mesh/Elements/elem: there is no node 99")) == 0);
   CHECK(Stopped("1,0,0</node>", "1,0</node>")
            .find(Entry(line("<node id=\"2\""),
                        "Mesh/Nodes/node: found 2 coordinates; there must be "
                        "three")) == 0);
   CHECK(Stopped("mat=\"tissue\"", "mat=\"bone\"")
            .find("the elements \"body\" (line " +
                  std::to_string(line("<Elements")) + ") have no material") !=
         std::string::npos);

   // Sets.
   CHECK(Stopped("node_set=\"bottom\"", "node_set=\"top\"") ==
         Entry(line("node_set=\"bottom\""),
               "Boundary/bc: there is no set of nodes called \"top\""));
   CHECK(Stopped(">1,2,3,4</NodeSet>", ">1,2,3</NodeSet>") ==
         Entry(line("node_set=\"bottom\""),
               "Boundary/bc: conditions go with surfaces here, but 3 of the "
               "nodes of \"bottom\" are on no outer face whose nodes are all "
               "in the set, such as node 1"));
   CHECK(Stopped("9,10,11,12</quad4>", "5,6,7,8</quad4>")
            .find("1 of the 1 facets of \"top\" are no outer faces") !=
         std::string::npos);
}

TEST_CASE("Fibers refer to the axes of the frame")
{
   const FebImport import =
      ImportFeb(Replaced(FebColumn(), R"(<solid type="neo-Hookean">
				<density>1</density>
				<E>2</E>
				<v>0.1</v>
			</solid>)",
                         R"(<solid type="solid mixture">
				<solid type="neo-Hookean"><E>2</E><v>0.1</v></solid>
				<solid type="fiber-NH">
					<mu>3</mu>
					<fiber type="angles"><theta>90</theta><phi>90</phi></fiber>
				</solid>
				<solid type="ellipsoidal fiber distribution">
					<beta>2,2.5,3</beta>
					<ksi>4,5,6</ksi>
				</solid>
				<solid type="continuous fiber distribution">
					<fibers type="fiber-exp-pow">
						<alpha>8</alpha><beta>2</beta><ksi>2.25</ksi><mu>0</mu>
					</fibers>
					<distribution type="von-Mises-3d"><b>2</b></distribution>
					<scheme type="fibers-3d-fei"><resolution>1796</resolution></scheme>
				</solid>
			</solid>)"),
                "model.feb");
   CHECK(import.report.Text(Fate::unsupported) == "");
   const MaterialCase &material = import.setup.materials[0];
   // The first axis is theta, the second r, the third z.
   CHECK(material.frame.axis == Point3{{1.0, 0.0, 0.0}});
   REQUIRE(material.solid.solids.size() == 4);
   const Point3 along = material.solid.solids[1].vectors.at("direction");
   CHECK(std::abs(along[0]) == Approx(1.0));
   CHECK(along[1] == Approx(0.0).margin(1e-12));
   CHECK(material.solid.solids[2].vectors.at("beta") ==
         Point3{{2.5, 2.0, 3.0}});
   CHECK(material.solid.solids[2].vectors.at("ksi") == Point3{{5.0, 4.0, 6.0}});
   const SolidCase &distribution = material.solid.solids[3];
   CHECK(distribution.parameters.at("b") == 2.0);
   CHECK(distribution.fibers.model == "fiber_exp_pow");
   CHECK(distribution.fibers.parameters.at("ksi") == 2.25);
   CheckCase(import.setup);
}

TEST_CASE("A symmetry plane holds the displacement across it")
{
   const std::string plane = R"(<Constraints>
		<constraint name="c" type="symmetry plane" surface="side">
			<laugon>1</laugon><tol>1e-6</tol><rhs>0</rhs>
		</constraint>
	</Constraints>
	<Loads>)";
   const auto with = [&](const std::string &facet)
   {
      return ImportFeb(Replaced(Replaced(FebColumn(), "<Loads>", plane),
                                "<Surface name",
                                "<Surface name=\"side\"><quad4 id=\"1\">" +
                                   facet + "</quad4></Surface><Surface name"),
                       "model.feb");
   };
   const FebImport import = with("1,2,6,5");
   CHECK_FALSE(import.report.IsStopped());
   const BoundaryCase &held = import.setup.boundaries.back();
   CHECK(held.surfaces == std::vector<std::string>{"side"});
   CHECK_FALSE(held.displacement[0].has_value());
   CHECK(held.displacement[1].has_value());
   CHECK_FALSE(held.displacement[2].has_value());
   const FebImport moved = ImportFeb(
      Replaced(Replaced(Replaced(FebColumn(), "<Loads>", plane),
                        "<Surface name",
                        "<Surface name=\"side\"><quad4 id=\"1\">1,2,6,5"
                        "</quad4></Surface><Surface name"),
               "1,0,1</node>", "1,0.5,1</node>"),
      "model.feb");
   CHECK(moved.report.Text(Fate::unsupported)
            .find("the surface must be a plane across x, y or z") !=
         std::string::npos);
}

TEST_CASE("A rigid spring joins two rigid bodies")
{
   const auto with = [](const std::string &connector)
   {
      std::string text =
         Replaced(FebColumn(), "</Material>",
                  R"(<material id="2" name="platen" type="rigid body">
			<density>1</density><center_of_mass>0.5,0.5,2</center_of_mass>
		</material><material id="3" name="anvil" type="rigid body">
			<density>1</density><center_of_mass>0.5,0.5,0</center_of_mass>
		</material></Material>)");
      text =
         Replaced(text, bottom_nodes, std::string(bottom_nodes) + top_nodes);
      text = Replaced(text, fixed_bottom,
                      R"(<bc name="lower" node_set="bottom" type="rigid">
			<rb>anvil</rb></bc><bc name="upper" node_set="lid" type="rigid">
			<rb>platen</rb></bc>)");
      text = Replaced(text, fixed_sides, "");
      return ImportFeb(
         Replaced(text, "<Loads>", "<Rigid>" + connector + "</Rigid><Loads>"),
         "model.feb");
   };
   const FebImport import =
      with(R"(<rigid_connector name="rope" type="rigid spring">
			<body_a>anvil</body_a><body_b>2</body_b>
			<insertion_a>0,0.5,0</insertion_a>
			<insertion_b>1,0.5,2</insertion_b>
			<free_length>1.5</free_length><k>0.25</k></rigid_connector>)");
   CHECK(import.report.Text(Fate::unsupported) == "");
   REQUIRE(import.setup.ligaments.size() == 1);
   const Ligament &rope = import.setup.ligaments.front();
   CHECK(rope.name == "rope");
   CHECK(rope.from.body == "anvil");
   CHECK(rope.to.body == "platen");
   CHECK(rope.to.point == Point3{{1.0, 0.5, 2.0}});
   CHECK(rope.options.stiffness == 0.25);
   CHECK(rope.options.slack_length == 1.5);
   CHECK(rope.options.compression);
   CHECK(with("<rigid_connector type=\"rigid damper\"/>")
            .report.Text(Fate::unsupported)
            .find("there is \"rigid spring\"") != std::string::npos);
}

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

TEST_CASE("A rigid shell that only touches becomes a region of a rigid body")
{
   const FebImport import = ImportFeb(FebPressedColumn(), "model.feb");
   CHECK(import.report.Text(Fate::unsupported) == "");
   CheckCase(import.setup);
   REQUIRE(import.setup.rigid_bodies.size() == 1);
   const RigidBodyCase &plate = import.setup.rigid_bodies[0];
   CHECK(plate.surfaces.empty());
   CHECK(plate.regions == std::vector<std::string>{"shell"});
   REQUIRE(import.setup.contacts.size() == 1);
   // The rigid side is the source, whichever is primary.
   CHECK(import.setup.contacts[0].source == std::vector<std::string>{"below"});
   CHECK(import.setup.contacts[0].destination ==
         std::vector<std::string>{"top"});
   const TemporaryDirectory directory(MPI_COMM_WORLD);
   const std::string file = directory.Path() + "/model.msh";
   directory.OnRootOnly([&]() { std::ofstream(file) << import.mesh; });
   NamedMesh mesh = ReadGmsh(file, MPI_COMM_WORLD);
   CHECK(mesh.Get().GetGlobalNE() == 3);
   // The shell's element is above the facet, which faces down.
   Vector low;
   Vector high;
   mesh.Get().GetBoundingBox(low, high);
   CHECK(high[2] > 2.1);
   CaseProblem problem(import.setup, mesh);
   CHECK_NOTHROW(problem.Get().Operator());
}

TEST_CASE("Tied surfaces are a tie, in all steps")
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
   text = Replaced(text, "\t<Loads>", contact + "\t<Loads>");
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

TEST_CASE("A solid without fluid is an elastic region")
{
   std::string text = Replaced(
      FebColumn(), "\t</Material>",
      R"(		<material id="2" name="bone" type="isotropic elastic">
			<density>1</density><E>20</E><v>0.3</v>
		</material>
	</Material>)");
   text = Replaced(text, "\t\t\t<elem id=\"2\">", R"(		</Elements>
		<Elements type="hex8" name="upper">
			<elem id="2">)");
   text = Replaced(text, "\t</MeshDomains>",
                   R"(		<SolidDomain name="upper" mat="tissue"/>
	</MeshDomains>)");
   text = Replaced(text, "name=\"body\" mat=\"tissue\"",
                   "name=\"body\" mat=\"bone\"");
   const FebImport import = ImportFeb(text, "model.feb");
   CHECK(import.report.Text(Fate::unsupported) == "");
   REQUIRE(import.setup.materials.size() == 2);
   const MaterialCase &bone = import.setup.materials[1];
   CHECK(bone.regions == std::vector<std::string>{"body"});
   CHECK_FALSE(bone.HasFluid());
   CHECK(bone.solid.model == "saint_venant_kirchhoff");
   CHECK(bone.solid_density == 0.0);
   CheckCase(import.setup);
   const FebImport other =
      ImportFeb(Replaced(text, "isotropic elastic", "multiphasic"), "a.feb");
   CHECK(other.report.Text(Fate::unsupported)
            .find("materials of the type \"multiphasic\" are not known") !=
         std::string::npos);
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
}

TEST_CASE("Body loads are forces per mass the other way round")
{
   const std::string text =
      Replaced(Replaced(FebColumn(), "\t<Loads>", R"(	<Loads>
		<body_load type="const"><z lc="1">3</z></body_load>)"),
               "<density>1</density>", "<density>2</density>");
   const FebImport import = ImportFeb(text, "model.feb");
   CHECK(import.report.Text(Fate::unsupported) == "");
   REQUIRE(import.setup.acceleration);
   CHECK((*import.setup.acceleration)[2](0.5) == Approx(-3.0));
   CHECK((*import.setup.acceleration)[0].IsZero());
   CHECK(import.setup.materials[0].solid_density == 2.0);
   CHECK(import.setup.materials[0].fluid_density == 1.0);
   CheckCase(import.setup);
   const FebImport other = ImportFeb(
      Replaced(text, "body_load type=\"const\"", "body_load type=\"spin\""),
      "model.feb");
   CHECK(other.report.Text(Fate::unsupported)
            .find("there are body loads of the type const") !=
         std::string::npos);
   CHECK(ImportFeb(Replaced(text, "<density>2", "<density>-2"), "model.feb")
            .report.IsStopped());
}

TEST_CASE("All that stops an import is listed")
{
   std::string text = Replaced(FebColumn(), "<E>2", "<E>two");
   text = Replaced(text, "zero fluid pressure", "zero temperature");
   text = Replaced(text, "<linear>0", "<linear>1");
   const FebImport import = ImportFeb(text, "model.feb");
   const std::string stops = import.report.Text(Fate::unsupported);
   CHECK(std::count(stops.begin(), stops.end(), '\n') == 3);
   CHECK(stops.find("\"zero temperature\"") != std::string::npos);
}

TEST_CASE("What is no model of FEBio is an error with a line")
{
   CHECK_THROWS_WITH(ImportFeb("", "a.feb"),
                     Catch::Contains("a.feb:1: this is no XML"));
   CHECK_THROWS_WITH(ImportFeb(Replaced(FebColumn(), "</Nodes>", ""), "a.feb"),
                     "a.feb:" + std::to_string(LineOf(FebColumn(), "</Mesh>")) +
                        ": this is no XML: Start-end tags mismatch");
   CHECK_THROWS_WITH(ImportFeb("\n<case/>", "a.feb"),
                     "a.feb:2: found <case>; a model of FEBio is in "
                     "<febio_spec>");
   CHECK_THROWS_WITH(
      ImportFeb(Replaced(FebColumn(), "version=\"4.0\"", "version=\"1.2\""),
                "a.feb"),
      "a.feb:2: found the format version \"1.2\"; there are 2.5, 3.0 and "
      "4.0");
   std::string deep;
   for (int i = 0; i < 100000; i++)
   {
      deep += "<a>";
   }
   for (int i = 0; i < 100000; i++)
   {
      deep += "</a>";
   }
   CHECK_THROWS_WITH(ImportFeb(deep, "a.feb"),
                     Catch::Contains("nested too deeply"));
}

TEST_CASE("Vessels of FEBio become a supply")
{
   const std::string permeability = "<permeability type=";
   const std::string text =
      Replaced(FebColumn(), permeability,
               "<solvent_supply type=\"Starling\"><kp>0.02</kp><pv>0.3</pv>"
               "</solvent_supply>" +
                  permeability);
   const FebImport import = ImportFeb(text, "model.feb");
   CHECK(import.report.Text(Fate::unsupported) == "");
   REQUIRE(import.setup.materials.size() == 1);
   const FluidSupply supply = import.setup.materials[0].supply.Supply();
   CHECK(supply.kp == 0.02);
   CHECK(supply.pc == 0.3);
   CHECK_THAT(
      Stopped(permeability, "<solvent_supply type=\"other\"/>" + permeability),
      Catch::Matchers::Contains("there is Starling"));
}

TEST_CASE("Tables of a log file become logs")
{
   const std::string plot = "<plotfile type=\"febio\">";
   const auto with = [&](const std::string &tables)
   {
      return Replaced(FebColumn(), plot,
                      "<logfile file=\"a.log\">" + tables + "</logfile>" +
                         plot);
   };
   const FebImport import = ImportFeb(
      with("<node_data data=\"ux;uz;Rz\" file=\"out/n.csv\" delim=\",\">"
           "1:9:4,12</node_data>"
           "<node_data data=\"p;vx\" node_set=\"bottom\"/>"
           "<node_data data=\"p\" node_set=\"@surface:top\"/>"
           "<element_data data=\"sx;J\" elem_set=\"body\" name=\"s\"/>"
           "<element_data data=\"sed\">1</element_data>"
           "<face_data data=\"contact gap\"/>"),
      "model.feb");
   CHECK(import.report.Text(Fate::unsupported) == "");
   const std::vector<LogDefinition> &logs = import.setup.output.logs;
   REQUIRE(logs.size() == 4);
   CHECK(logs[0].file == "n.csv");
   CHECK(logs[0].of == LogSubject::nodes);
   CHECK(logs[0].data == std::vector<std::string>{"ux", "uz", "Rz"});
   CHECK(logs[0].numbers == std::vector<int>{1, 5, 9, 12});
   CHECK(logs[0].delimiter == ",");
   CHECK(logs[1].file == "node_data.txt");
   CHECK(logs[1].data == std::vector<std::string>{"p"});
   CHECK(logs[1].numbers == std::vector<int>{1, 2, 3, 4});
   CHECK(logs[2].file == "2_node_data.txt");
   CHECK(logs[2].numbers == std::vector<int>{9, 10, 11, 12});
   CHECK(logs[3].of == LogSubject::elements);
   CHECK(logs[3].numbers == std::vector<int>{1, 2});
   CHECK_THAT(import.report.Text(Fate::approximated),
              Catch::Matchers::Contains("the log leaves out \"vx\""));
   for (const std::string tables :
        {"<node_data data=\"x\">1:a</node_data>",
         "<node_data data=\"x\">3:1</node_data>",
         "<node_data data=\"x\" node_set=\"none\"/>",
         "<element_data data=\"p\" elem_set=\"none\"/>",
         "<rigid_body_data data=\"x\">7</rigid_body_data>"})
   {
      CAPTURE(tables);
      CHECK(ImportFeb(with(tables), "model.feb").report.IsStopped());
   }
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

TEST_CASE("A ligament of FEBio is along the first of its axes")
{
   std::string text =
      Replaced(FebColumn(), "<solid type=\"neo-Hookean\">",
               "<mat_axis type=\"vector\"><a>0,1,0</a><d>-1,0,0</d></mat_axis>"
               "<solid type=\"PRLig\"><c1>90</c1><c2>160</c2><mu>0.025</mu>"
               "<v0>5.85</v0><m>-100</m><k>1.55</k>"
               "<mat_axis type=\"vector\"><a>0,0,1</a><d>1,0,0</d></mat_axis>");
   text = Replaced(text, "<E>2</E>", "");
   text = Replaced(text, "<v>0.1</v>", "");
   const FebImport import = ImportFeb(text, "model.feb");
   CHECK(import.report.Text(Fate::unsupported) == "");
   REQUIRE(import.setup.materials.size() == 1);
   const MaterialCase &material = import.setup.materials[0];
   CHECK(material.solid.model == "prlig");
   CHECK(material.solid.parameters.at("v0") == 5.85);
   CHECK(material.solid.parameters.at("m") == -100.0);
   // Theta of the frame is the first of the material's axes, and z stays.
   const Point3 &direction = material.solid.vectors.at("direction");
   CHECK(std::abs(direction[1]) < 1e-12);
   CHECK(std::hypot(direction[0], direction[2]) == Approx(1.0));
   CHECK(material.frame.axis[1] == Approx(1.0));
}
