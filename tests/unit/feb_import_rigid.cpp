// ranks: 1 2
//
// Rigid bodies of FEBio: springs between them, shells that only touch.

#include "support/feb_column_parts.hpp"
#include "support/feb_text.hpp"
#include "support/temporary_directory.hpp"
#include "synovia/cases/case_problem.hpp"
#include "synovia/feb/feb_import.hpp"

#include <catch2/catch.hpp>

#include <fstream>

using namespace mfem;
using namespace synovia;
using namespace synovia::feb_column;

namespace
{
using Fate = FebReport::Fate;

// The column between two rigid bodies, connected.
std::string ConnectedText(const std::string &connector)
{
   std::string text =
      Replaced(FebColumn(), "</Material>",
               R"(<material id="2" name="platen" type="rigid body">
			<density>1</density><center_of_mass>0.5,0.5,2</center_of_mass>
		</material><material id="3" name="anvil" type="rigid body">
			<density>1</density><center_of_mass>0.5,0.5,0</center_of_mass>
		</material></Material>)");
   text = Replaced(text, bottom_nodes, std::string(bottom_nodes) + top_nodes);
   text = Replaced(text, fixed_bottom,
                   R"(<bc name="lower" node_set="bottom" type="rigid">
			<rb>anvil</rb></bc><bc name="upper" node_set="lid" type="rigid">
			<rb>platen</rb></bc>)");
   text = Replaced(text, fixed_sides, "");
   return Replaced(text, "<Loads>", "<Rigid>" + connector + "</Rigid><Loads>");
}

FebImport Connected(const std::string &connector)
{
   return ImportFeb(ConnectedText(connector), "model.feb");
}
} // namespace

TEST_CASE("A rigid spring joins two rigid bodies")
{
   const FebImport import =
      Connected(R"(<rigid_connector name="rope" type="rigid spring">
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
   CHECK(Connected("<rigid_connector type=\"rigid damper\"/>")
            .report.Text(Fate::unsupported)
            .find("there are rigid spring") != std::string::npos);
}

TEST_CASE("Discrete springs join the rigid bodies of their nodes")
{
   const auto with = [](const std::string &material, const std::string &nodes)
   {
      const std::string section =
         "<Discrete><discrete_material id=\"1\" name=\"m\" type=\"" + material +
         "\"><E>0.5</E></discrete_material><discrete dmat=\"1\" "
         "discrete_set=\"ropes\"/></Discrete>";
      const std::string set =
         "<DiscreteSet name=\"ropes\">" + nodes + "</DiscreteSet>";
      std::string text = ConnectedText("");
      text = Replaced(text, "</Mesh>", set + "</Mesh>");
      return ImportFeb(Replaced(text, "<Loads>", section + "<Loads>"),
                       "model.feb");
   };
   const FebImport import =
      with("linear spring", "<delem>1,9</delem><delem>2,11</delem>");
   CHECK(import.report.Text(Fate::unsupported) == "");
   CheckCase(import.setup);
   REQUIRE(import.setup.ligaments.size() == 2);
   const Ligament &rope = import.setup.ligaments[1];
   CHECK(rope.name == "ropes_2");
   CHECK(rope.from.body == "anvil");
   CHECK(rope.to.body == "platen");
   CHECK(rope.from.point == Point3{{1.0, 0.0, 0.0}});
   CHECK(rope.to.point == Point3{{1.0, 1.0, 2.0}});
   CHECK(rope.options.stiffness == 0.5);
   CHECK(rope.options.slack_length == 0.0);
   CHECK(rope.options.compression);
   const FebImport slack =
      with("tension-only linear spring", "<delem>1,9</delem>");
   REQUIRE(slack.setup.ligaments.size() == 1);
   CHECK(slack.setup.ligaments[0].name == "ropes");
   CHECK_FALSE(slack.setup.ligaments[0].options.compression);
   const auto refused = [&](const std::string &material,
                            const std::string &nodes, const std::string &why)
   {
      CAPTURE(why);
      CHECK(with(material, nodes).report.Text(Fate::unsupported).find(why) !=
            std::string::npos);
   };
   refused("Hill", "<delem>1,9</delem>", "there are linear spring");
   refused("linear spring", "<delem>1,5</delem>", "node 5 belongs to no rigid");
   refused("linear spring", "<delem>1,2</delem>", "bears nothing");
   refused("linear spring", "<delem>1,99</delem>", "there is no node 99");
   refused("linear spring", "<delem>1,9,2</delem>", "has two nodes");
}

TEST_CASE("Freedoms of rigid bodies are fixed, prescribed and loaded")
{
   const auto entry = [](const std::string &element, const std::string &type,
                         const std::string &dof, const std::string &value)
   {
      return "<" + element + " type=\"" + type + "\"><rb>platen</rb><dof>" +
             dof + "</dof><value lc=\"1\">" + value + "</value></" + element +
             ">";
   };
   const FebImport import =
      Connected("<rigid_bc type=\"rigid_fixed\"><rb>2</rb><Rx_dof>1</Rx_dof>"
                "<Rv_dof>1</Rv_dof></rigid_bc>" +
                entry("rigid_bc", "rigid_displacement", "z", "-0.1") +
                entry("rigid_bc", "rigid_rotation", "Ru", "0.2") +
                entry("rigid_load", "rigid_force", "Ry", "3") +
                entry("rigid_load", "rigid_moment", "Rw", "4"));
   CHECK(import.report.Text(Fate::unsupported) == "");
   CheckCase(import.setup);
   REQUIRE(import.setup.rigid_bodies.size() == 2);
   const RigidBodyCase &body = import.setup.rigid_bodies[0];
   CHECK(body.name == "platen");
   CHECK(*body.reference == Point3{{0.5, 0.5, 2.0}});
   CHECK(body.translation[0]->IsZero());
   CHECK_FALSE(body.translation[1]);
   // lc 1 is 2 from t = 1 on.
   CHECK((*body.translation[2])(2.0) == Approx(-0.2));
   CHECK((*body.rotation[0])(2.0) == Approx(0.4));
   CHECK(body.rotation[1]->IsZero());
   CHECK_FALSE(body.rotation[2]);
   CHECK((*body.force)[1](2.0) == Approx(6.0));
   CHECK((*body.moment)[2](2.0) == Approx(8.0));
}

TEST_CASE("Joints of rigid bodies hold what they don't leave free")
{
   const auto with = [](const std::string &type, const std::string &rest)
   {
      return Connected("<rigid_connector name=\"hinge\" type=\"" + type +
                       "\"><body_a>anvil</body_a><body_b>platen</body_b>"
                       "<laugon>1</laugon><force_penalty>10</force_penalty>" +
                       rest + "</rigid_connector>");
   };
   const auto free_of = [](const FebImport &import)
   {
      CHECK(import.report.Text(Fate::unsupported) == "");
      CheckCase(import.setup);
      REQUIRE(import.setup.joints.size() == 1);
      std::vector<std::string> names;
      for (int k = 0; k < 6; k++)
      {
         if (!import.setup.joints[0].prescribed[k])
         {
            names.push_back(JointCoordinateNames()[k]);
         }
      }
      return names;
   };
   using Names = std::vector<std::string>;
   const std::string origin = "<joint_origin>0.5,0.5,1</joint_origin>";
   const std::string turn = "<rotation_axis>0,0,2</rotation_axis>"
                            "<transverse_axis>1,0,0</transverse_axis>";
   const FebImport hinge = with("rigid revolute joint", origin + turn);
   CHECK(free_of(hinge) == Names{"flexion"});
   const Joint &joint = hinge.setup.joints[0];
   CHECK(joint.name == "hinge");
   CHECK(joint.proximal.body == "anvil");
   CHECK(joint.distal.body == "platen");
   CHECK(joint.distal.origin == Point3{{0.5, 0.5, 1.0}});
   // About the reverse of which a distal body flexes.
   CHECK(joint.proximal.flexion_axis == Point3{{0.0, 0.0, -1.0}});
   const FebImport driven = with(
      "rigid revolute joint", origin + turn +
                                 "<prescribed_rotation>1</prescribed_rotation>"
                                 "<rotation lc=\"1\">0.2</rotation>");
   CHECK(free_of(driven).empty());
   CHECK((*driven.setup.joints[0].prescribed[0])(0.5) == Approx(0.2));
   const FebImport slider =
      with("rigid prismatic joint",
           origin + "<translation_axis>1,0,0</translation_axis>"
                    "<transverse_axis>0,1,0</transverse_axis>"
                    "<prescribed_translation>1</prescribed_translation>"
                    "<translation>0.3</translation>");
   CHECK((*slider.setup.joints[0].prescribed[3])(0.5) == Approx(-0.3));
   CHECK(free_of(with("rigid cylindrical joint",
                      origin + "<joint_axis>1,0,0</joint_axis>"
                               "<transverse_axis>0,1,0</transverse_axis>")) ==
         Names{"flexion", "lateral"});
   CHECK(free_of(with("rigid planar joint",
                      origin + "<rotation_axis>1,0,0</rotation_axis>"
                               "<translation_axis_1>0,1,0"
                               "</translation_axis_1>")) ==
         Names{"flexion", "anterior", "distraction"});
   CHECK(free_of(with("rigid spherical joint", origin)) ==
         Names{"flexion", "abduction", "internal_rotation"});
   CHECK(free_of(with("rigid joint", "<joint>0.5,0.5,1</joint>")) ==
         Names{"flexion", "abduction", "internal_rotation"});
   CHECK(free_of(with("rigid lock", origin)).empty());
   CHECK(with("rigid revolute joint", origin + turn + "<moment>1</moment>")
            .report.Text(Fate::unsupported)
            .find("are not known") != std::string::npos);
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

TEST_CASE("What is prescribed of a rigid body counts before what is fixed")
{
   const std::string fixed =
      "<rigid_bc type=\"rigid_fixed\"><rb>platen</rb><Rx_dof>1</Rx_dof>"
      "<Rz_dof>1</Rz_dof></rigid_bc>";
   const std::string moved =
      "<rigid_bc type=\"rigid_displacement\"><rb>platen</rb><dof>z</dof>"
      "<value lc=\"1\">0.1</value></rigid_bc>";
   for (const std::string &entries : {fixed + moved, moved + fixed})
   {
      const FebImport import = Connected(entries);
      CHECK(import.report.Text(Fate::unsupported) == "");
      const RigidBodyCase &body = import.setup.rigid_bodies[0];
      CHECK(body.translation[0]->IsZero());
      CHECK((*body.translation[2])(0.5) == Approx(0.1));
   }
}

TEST_CASE("Loads of a rigid body add up, and body loads may not move it")
{
   const std::string twice =
      "<rigid_load type=\"rigid_force\"><rb>platen</rb><dof>Rx</dof>"
      "<value>3</value></rigid_load><rigid_load type=\"rigid_force\"><rb>2</rb>"
      "<dof>Rx</dof><value lc=\"1\">1</value></rigid_load>";
   const FebImport import = Connected(twice);
   CHECK(import.report.Text(Fate::unsupported) == "");
   // lc 1 is 1 at t = 0.5.
   CHECK((*import.setup.rigid_bodies[0].force)[0](0.5) == Approx(4.0));

   const std::string fixed_anvil =
      "<rigid_bc type=\"rigid_fixed\"><rb>anvil</rb><Rx_dof>1</Rx_dof>"
      "<Ry_dof>1</Ry_dof><Rz_dof>1</Rz_dof><Ru_dof>1</Ru_dof><Rv_dof>1</Rv_dof>"
      "<Rw_dof>1</Rw_dof></rigid_bc>";
   const std::string heavy =
      Replaced(ConnectedText(fixed_anvil), "<Loads>",
               "<Loads><body_load type=\"const\"><z>1</z></body_load>");
   const std::string stops =
      ImportFeb(heavy, "model.feb").report.Text(Fate::unsupported);
   CHECK(stops ==
         "  line " + std::to_string(LineOf(heavy, "name=\"platen\"")) +
            ": Material/material: body loads that act on rigid bodies are not "
            "known; make its density 0, and its weight a rigid_force\n");
   const FebImport light =
      ImportFeb(Replaced(heavy, "<density>1</density><center_of_mass>0.5,0.5,2",
                         "<density>0</density><center_of_mass>0.5,0.5,2"),
                "model.feb");
   CHECK(light.report.Text(Fate::unsupported) == "");
}
