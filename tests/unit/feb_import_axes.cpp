// ranks: 1
//
// Axes of materials and directions of fibers of FEBio, which may differ from
// element to element: what frame they become, and what vectors of the mesh.

#include "support/feb_text.hpp"
#include "support/temporary_directory.hpp"
#include "synovia/cases/case_problem.hpp"
#include "synovia/feb/feb_import.hpp"
#include "synovia/materials/material_frame.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
using Fate = FebReport::Fate;
using Catch::Matchers::Contains;

// The column with fibers, beside what else the material has, and with data of
// the mesh.
FebImport WithFibers(const std::string &fiber, const std::string &axes = "",
                     const std::string &data = "")
{
   std::string text = Replaced(FebColumn(), R"(<solid type="neo-Hookean">
				<density>1</density>
				<E>2</E>
				<v>0.1</v>
			</solid>)",
                               axes + R"(<solid type="solid mixture">
				<solid type="neo-Hookean"><E>2</E><v>0.1</v></solid>
				<solid type="fiber-NH"><mu>3</mu>)" +
                                  fiber + "</solid></solid>");
   text = Replaced(text, "<Boundary>",
                   "<MeshData>" + data + "</MeshData>\n<Boundary>");
   return ImportFeb(text, "model.feb");
}

const Point3 &DirectionOf(const FebImport &import)
{
   return import.setup.materials[0].solid.solids[1].vectors.at("direction");
}

// Of the vectors of both elements.
std::vector<Point3> VectorsOf(const FebImport &import)
{
   REQUIRE(import.report.Text(Fate::unsupported) == "");
   CheckCase(import.setup);
   const FrameCase &frame = import.setup.materials[0].frame;
   REQUIRE(frame.type == FrameType::field);
   CHECK(DirectionOf(import) == Point3{{0.0, 1.0, 0.0}});
   const TemporaryDirectory directory;
   NamedMesh mesh =
      ReadGmsh(directory.Write("model.msh", import.mesh), MPI_COMM_WORLD);
   CaseProblem problem(import.setup, mesh);
   CHECK_NOTHROW(problem.Get().Operator());
   return mesh.Vectors(frame.name).vectors;
}

// The same everywhere.
Point3 UniformOf(const FebImport &import)
{
   REQUIRE(import.report.Text(Fate::unsupported) == "");
   const FrameCase &frame = import.setup.materials[0].frame;
   REQUIRE(frame.type == FrameType::cartesian);
   const Tensor3<> axes = AxesAlong(frame.axis);
   const Point3 &local = DirectionOf(import);
   Point3 vector{{0.0, 0.0, 0.0}};
   for (int j = 0; j < 3; j++)
   {
      vector = Sum(vector, local[j], {axes[0][j], axes[1][j], axes[2][j]});
   }
   return vector;
}

void CheckAlike(const Point3 &a, const Point3 &b)
{
   CAPTURE(a[0], a[1], a[2], b[0], b[1], b[2]);
   CHECK(Length(Sum(a, -1.0, b)) < 1e-12);
}

const std::string along_third = R"(<fiber type="vector">0,0,1</fiber>)";
} // namespace

TEST_CASE("Axes by angles are the same in all elements")
{
   const std::string axes = R"(<mat_axis type="angles"><theta>90</theta>
		<phi>90</phi></mat_axis>)";
   CheckAlike(UniformOf(WithFibers("", axes)), {0.0, 1.0, 0.0});
   CheckAlike(
      UniformOf(WithFibers(R"(<fiber type="vector">0,1,0</fiber>)", axes)),
      {-1.0, 0.0, 0.0});
   CheckAlike(UniformOf(WithFibers(along_third, axes)), {0.0, 0.0, 1.0});
}

TEST_CASE("Nodes of elements give directions")
{
   const real_t third = 1.0 / std::sqrt(3.0);
   for (const Point3 &vector : VectorsOf(
           WithFibers(R"(<fiber type="local"><local>1,7</local></fiber>)")))
   {
      CheckAlike(vector, {third, third, third});
   }
   for (const std::string nodes : {"1,2,4", "0,0,0"})
   {
      for (const Point3 &vector :
           VectorsOf(WithFibers(along_third, R"(<mat_axis type="local">)" +
                                                nodes + "</mat_axis>")))
      {
         CheckAlike(vector, {0.0, 0.0, 1.0});
      }
   }
   CHECK_THAT(WithFibers(R"(<fiber type="local"><local>1,9</local></fiber>)")
                 .report.Text(Fate::unsupported),
              Contains("the elements \"body\" have no node 9"));
}

TEST_CASE("Directions around a line along z are those of a cylinder")
{
   const std::string line = "<center>3,0.5,0</center><axis>0,0,1</axis>";
   const auto check = [](const FebImport &import, const Point3 &direction)
   {
      REQUIRE(import.report.Text(Fate::unsupported) == "");
      const FrameCase &frame = import.setup.materials[0].frame;
      CHECK(frame.type == FrameType::cylindrical);
      CHECK(frame.origin == Point3{{3.0, 0.5, 0.0}});
      CHECK(frame.axis == Point3{{0.0, 0.0, 1.0}});
      CheckAlike(DirectionOf(import), direction);
      CheckCase(import.setup);
   };
   check(WithFibers(R"(<fiber type="cylindrical">)" + line +
                    "<vector>0,1,0</vector></fiber>"),
         {0.0, 1.0, 0.0});
   // The first axis is around the line, the second along it.
   const std::string axes = R"(<mat_axis type="cylindrical">)" + line +
                            "<vector>0,1,0</vector></mat_axis>";
   check(WithFibers("", axes), {0.0, 1.0, 0.0});
   check(WithFibers(along_third, axes), {1.0, 0.0, 0.0});
}

TEST_CASE("Directions around other lines and points are those of centers")
{
   // Seen from there the center of the first element is along y.
   const FebImport around = WithFibers(R"(<fiber type="cylindrical">
		<center>0,-5,0.5</center><axis>1,0,0</axis><vector>0,0,1</vector></fiber>)");
   CHECK_THAT(around.report.Text(Fate::approximated),
              Contains("at the centers of the elements"));
   CheckAlike(VectorsOf(around)[0], {0.0, -1.0, 0.0});
   const real_t away = std::hypot(5.5, 1.0);
   CheckAlike(VectorsOf(around)[1], {0.0, -5.5 / away, -1.0 / away});
   for (const std::string outer : {"fiber", "mat_axis"})
   {
      const std::string words = "<" + outer + R"( type="spherical">
		<center>0.5,-0.5,0.5</center><vector>1,0,0</vector></)" +
                                outer + ">";
      const std::vector<Point3> vectors = VectorsOf(
         outer == "fiber" ? WithFibers(words) : WithFibers("", words));
      CheckAlike(vectors[0], {0.0, 1.0, 0.0});
      CheckAlike(vectors[1], {0.0, std::sqrt(0.5), std::sqrt(0.5)});
   }
}

TEST_CASE("Data of the mesh give directions")
{
   const std::string of_body = R"(elem_set="body")";
   const std::string vectors = R"(<elem lid="1">0,0,2</elem>
		<elem lid="2">1,0,0</elem></ElementData>)";
   const std::vector<FebImport> imports{
      WithFibers(R"(<fiber type="map">dirs</fiber>)", "",
                 R"(<ElementData name="dirs" data_type="vec3" )" + of_body +
                    ">" + vectors),
      WithFibers("", "",
                 R"(<ElementData type="fiber" )" + of_body + ">" + vectors),
      WithFibers("", "",
                 R"(<ElementData type="mat_axis" )" + of_body +
                    R"(><elem lid="1"><a>0,0,1</a><d>1,0,0</d></elem>
		<elem lid="2"><a>1,0,0</a><d>0,1,0</d></elem></ElementData>)")};
   for (const FebImport &import : imports)
   {
      const std::vector<Point3> found = VectorsOf(import);
      CheckAlike(found[0], {0.0, 0.0, 1.0});
      CheckAlike(found[1], {1.0, 0.0, 0.0});
   }
   CHECK_THAT(WithFibers(R"(<fiber type="map">none</fiber>)")
                 .report.Text(Fate::unsupported),
              Contains("no vectors called \"none\""));
   CHECK_THAT(
      WithFibers("", "", R"(<ElementData type="fiber" elem_set="x">)" + vectors)
         .report.Text(Fate::unsupported),
      Contains("no set of elements called \"x\""));
}

TEST_CASE("Where they differ there is one direction")
{
   const FebImport import = WithFibers(
      R"(<fiber type="local"><local>1,2</local></fiber></solid>
		<solid type="fiber-NH"><mu>1</mu>
		<fiber type="local"><local>1,5</local></fiber>)");
   CHECK_THAT(import.report.Text(Fate::unsupported),
              Contains("a material has one direction"));
   const FebImport alike = WithFibers(
      R"(<fiber type="local"><local>1,2</local></fiber></solid>
		<solid type="fiber-NH"><mu>1</mu>
		<fiber type="local"><local>4,3</local></fiber>)");
   CheckAlike(VectorsOf(alike)[0], {1.0, 0.0, 0.0});
}
