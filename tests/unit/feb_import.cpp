// ranks: 1 2
//
// Models of FEBio: what a small one becomes, as case and as mesh, and the same
// in former formats.

#include "synovia/feb/feb_import.hpp"
#include "support/feb_column_parts.hpp"
#include "support/feb_text.hpp"
#include "support/temporary_directory.hpp"

#include <catch2/catch.hpp>

#include <fstream>

using namespace mfem;
using namespace synovia;
using namespace synovia::feb_column;

namespace
{
using Fate = FebReport::Fate;

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

TEST_CASE(
   "What is prescribed holds where others are zero, whatever comes first")
{
   const std::string pull =
      "<bc node_set=\"@surface:top\" type=\"prescribed displacement\"><dof>x"
      "</dof><value lc=\"1\">0.1</value></bc>";
   const std::string lift =
      "<bc node_set=\"bottom\" type=\"prescribed displacement\"><dof>z</dof>"
      "<value lc=\"1\">0.2</value></bc>";
   std::string before =
      Replaced(FebColumn(), fixed_sides, pull + lift + "\n\t\t" + fixed_sides);
   std::string after =
      Replaced(FebColumn(), drained, drained + ("\n\t\t" + pull + lift));
   for (const std::string &text : {before, after})
   {
      const FebImport import = ImportFeb(text, "model.feb");
      CHECK(import.report.Text(Fate::unsupported) == "");
      const std::vector<BoundaryCase> &conditions = import.setup.boundaries;
      // The zeros along z at the bottom are gone.
      REQUIRE(conditions.size() == 5);
      CHECK(conditions[0].surfaces == std::vector<std::string>{"all"});
      CHECK(conditions[1].pressure.has_value());
      CHECK((*conditions[2].displacement[0])(0.5) == Approx(0.1));
      CHECK((*conditions[3].displacement[2])(0.5) == Approx(0.2));
      CHECK(conditions[4].normal_traction.has_value());
   }
}
