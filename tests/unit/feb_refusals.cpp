// ranks: 1 2
//
// Models of FEBio: each thing that is not known is named with its line and
// path, and stops the import; what is no model at all is an error.

#include "support/feb_text.hpp"
#include "synovia/feb/feb_import.hpp"
#include "synovia/general/error.hpp"

#include <catch2/catch.hpp>

#include <algorithm>

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
   CHECK(Stopped("<node id=\"2\"", "<node id=\"9223372036854775807\"")
            .find(Entry(line("<node id=\"2\""),
                        "Mesh/Nodes/node: found "
                        "id=\"9223372036854775807\"; it must be an integer "
                        "of at most 15 digits")) == 0);
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

TEST_CASE("What moves and loads a model otherwise stops its import")
{
   const std::string text = FebColumn();
   const auto stops = [&](const std::string &before, const std::string &added,
                          const std::string &entry)
   {
      CHECK(Stopped(before, added + before)
               .find("  line " + std::to_string(LineOf(text, before)) + ": " +
                     entry) == 0);
   };
   stops("</Boundary>",
         "<bc type=\"linear constraint\"><node>9</node><dof>z</dof><child_dof>"
         "<node>10</node><dof>z</dof><value>1</value></child_dof></bc>",
         "Boundary/bc: conditions of the type \"linear constraint\" are not");
   stops("</Boundary>",
         "<bc type=\"normal displacement\" surface=\"top\"><scale>1</scale>"
         "</bc>",
         "Boundary/bc: conditions of the type \"normal displacement\" are not");
   stops("</Loads>",
         "<nodal_load type=\"nodal_load\" node_set=\"bottom\"><dof>z</dof>"
         "<scale>1</scale></nodal_load>",
         "Loads/nodal_load: loads of nodes of the type \"nodal_load\" are not");
   stops("<Loads>", "<Initial><ic type=\"initial fluid pressure\"/></Initial>",
         "Initial: this is not known");
   stops("<Loads>",
         "<Rigid><rigid_load type=\"rigid_follower_force\"><force>1,0,0"
         "</force></rigid_load></Rigid>",
         "Rigid/rigid_load: \"rigid_follower_force\" is not known");
   stops("<Loads>",
         "<Rigid><rigid_connector type=\"rigid angular damper\"><c>1</c>"
         "</rigid_connector></Rigid>",
         "Rigid/rigid_connector: connectors of the type \"rigid angular "
         "damper\" are not known");
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
