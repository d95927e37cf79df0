// ranks: 1
//
// Loads and constraints of FEBio: body loads and symmetry planes.

#include "support/feb_text.hpp"
#include "synovia/cases/case_problem.hpp"
#include "synovia/feb/feb_import.hpp"

#include <catch2/catch.hpp>

using namespace mfem;
using namespace synovia;

namespace
{
using Fate = FebReport::Fate;
} // namespace

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
            .find("the surface must be a plane") != std::string::npos);
   // A side that leans.
   std::string leaning =
      Replaced(Replaced(FebColumn(), "<Loads>", plane), "<Surface name",
               "<Surface name=\"side\"><quad4 id=\"1\">1,2,6,5</quad4>"
               "<quad4 id=\"2\">5,6,10,9</quad4></Surface><Surface name");
   leaning = Replaced(leaning, "0,0,1</node>", "0,0.1,1</node>");
   leaning = Replaced(leaning, "1,0,1</node>", "1,0.1,1</node>");
   leaning = Replaced(leaning, "0,0,2</node>", "0,0.2,2</node>");
   leaning = Replaced(leaning, "1,0,2</node>", "1,0.2,2</node>");
   const FebImport guided = ImportFeb(leaning, "model.feb");
   CHECK(guided.report.Text(Fate::unsupported) == "");
   REQUIRE(guided.setup.boundaries.back().guide.has_value());
   const Point3 &normal = *guided.setup.boundaries.back().guide;
   CHECK(normal[0] == Approx(0.0).margin(1e-12));
   CHECK(normal[2] / normal[1] == Approx(-0.1));
}

TEST_CASE("Linear constraints of single nodes hold them to planes")
{
   const auto with = [](const std::string &z)
   {
      std::string entries;
      for (const int node : {1, 2, 5, 6, 9, 10})
      {
         const std::string start = "<node id=\"" + std::to_string(node);
         entries += "<linear_constraint>" + start + "\" bc=\"y\">2</node>" +
                    start + "\" bc=\"z\">" + z +
                    "</node></linear_constraint>\n";
      }
      return ImportFeb(
         Replaced(FebColumn(), "<Loads>",
                  "<Constraints><constraint type=\"linear constraint\">"
                  "<laugon>1</laugon><tol>0.1</tol>" +
                     entries + "</constraint></Constraints>\n<Loads>"),
         "model.feb");
   };
   const FebImport straight = with("0");
   CHECK(straight.report.Text(Fate::unsupported) == "");
   const BoundaryCase &held = straight.setup.boundaries.back();
   CHECK_FALSE(held.displacement[0].has_value());
   CHECK(held.displacement[1].has_value());
   CHECK_FALSE(held.displacement[2].has_value());
   CheckCase(straight.setup);
   const FebImport leaning = with("-1");
   REQUIRE(leaning.setup.boundaries.back().guide.has_value());
   const Point3 &normal = *leaning.setup.boundaries.back().guide;
   CHECK(normal[2] / normal[1] == Approx(-0.5));
   const FebImport joined = with("-1</node><node id=\"7\" bc=\"x\">1");
   CHECK(joined.report.Text(Fate::unsupported)
            .find("of one node, which keeps to a plane") != std::string::npos);
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

namespace
{
// What a load on the top of the column becomes, which has this condition there.
FebImport Loaded(const std::string &load, const std::string &condition)
{
   std::string text = FebColumn();
   const size_t begin = text.find("\t<Loads>");
   const size_t end = text.find("\t<LoadData>");
   text = text.substr(0, begin) + "<Loads>" + load + "</Loads>\n" +
          text.substr(end);
   return ImportFeb(Replaced(text,
                             "<bc name=\"drained\" node_set=\"@surface:top\" "
                             "type=\"zero fluid pressure\"/>",
                             condition),
                    "model.feb");
}

const BoundaryCase &LastOf(const FebImport &import)
{
   REQUIRE(import.report.Text(Fate::unsupported) == "");
   CheckCase(import.setup);
   return import.setup.boundaries.back();
}
} // namespace

TEST_CASE("Loads on surfaces have their signs")
{
   const auto on_top = [](const std::string &type, const std::string &rest)
   {
      return "<surface_load surface=\"top\" type=\"" + type + "\">" + rest +
             "</surface_load>";
   };
   // lc 1 is 2 from t = 1 on.
   const FebImport vector =
      Loaded(on_top("traction", "<scale lc=\"1\">0.5</scale>"
                                "<traction>1,2,-3</traction>"),
             "");
   CHECK((*LastOf(vector).traction)[1](1.0) == Approx(2.0));
   CHECK((*LastOf(vector).traction)[2](1.0) == Approx(-3.0));
   CHECK(vector.report.Text(Fate::approximated).find("per undeformed area") !=
         std::string::npos);
   CHECK((*LastOf(Loaded(on_top("pressure", "<pressure>0.4</pressure>"), ""))
              .normal_traction)(1.0) == Approx(-0.4));
   CHECK((*LastOf(Loaded(on_top("fluidflux", "<flux>-0.1</flux>"
                                             "<mixture>0</mixture>"),
                         ""))
              .normal_flux)(1.0) == Approx(-0.1));
   CHECK((*LastOf(Loaded(on_top("fluidflux", "<flux>-0.1</flux>"
                                             "<mixture>1</mixture>"),
                         ""))
              .mixture_flux)(1.0) == Approx(-0.1));
   const std::string effective = on_top(
      "normal_traction", "<traction>-0.3</traction><effective>1</effective>");
   CHECK((*LastOf(Loaded(effective, "")).effective_traction)(1.0) ==
         Approx(-0.3));
   // The pressure that is prescribed there adds.
   CHECK((*LastOf(Loaded(effective, "<bc node_set=\"@surface:top\" "
                                    "type=\"prescribed fluid pressure\">"
                                    "<value lc=\"1\">0.2</value></bc>"))
              .normal_traction)(1.0) == Approx(-0.7));
   const FebImport nodal =
      Loaded("<nodal_load node_set=\"bottom\" type=\"nodal fluidflux\">"
             "<value>0.05</value></nodal_load>",
             "");
   // A quarter of the area at each node.
   CHECK((*LastOf(nodal).normal_flux)(1.0) == Approx(0.2));
}

TEST_CASE("Loads on the same surface add up")
{
   const auto with = [](const std::string &load)
   {
      return ImportFeb(Replaced(FebColumn(), "</Loads>", load + "\n</Loads>"),
                       "model.feb");
   };
   const FebImport import =
      with("<surface_load surface=\"top\" type=\"pressure\"><pressure>0.3"
           "</pressure></surface_load><surface_load surface=\"top\" "
           "type=\"traction\"><traction>1,0,0</traction></surface_load>"
           "<surface_load surface=\"top\" type=\"traction\">"
           "<scale lc=\"1\">2</scale><traction>0,1,0</traction>"
           "</surface_load>");
   CHECK(import.report.Text(Fate::unsupported) == "");
   REQUIRE(import.setup.boundaries.size() == 5);
   // lc 1 is 1 at t = 0.5.
   CHECK((*import.setup.boundaries[3].normal_traction)(0.5) == Approx(-0.8));
   const auto &traction = *import.setup.boundaries[4].traction;
   CHECK(traction[0](0.5) == 1.0);
   CHECK(traction[1](0.5) == Approx(2.0));
   const FebImport drained =
      with("<surface_load surface=\"top\" type=\"fluidflux\"><flux>1</flux>"
           "</surface_load>");
   CHECK(drained.report.Text(Fate::unsupported)
            .find("Loads/surface_load: \"top\" has a condition that excludes "
                  "this one") != std::string::npos);
}
