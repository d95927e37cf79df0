// Frames that differ from element to element: vectors in the mesh file, and
// vectors that are projected on surfaces.

// ranks: 1 2 3
// fixtures: gmsh_meshes

#include "support/boxes.hpp"
#include "support/gmsh_meshes.hpp"
#include "support/msh_text.hpp"
#include "support/round_meshes.hpp"
#include "support/temporary_directory.hpp"
#include "synovia/cases/case_problem.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>

using namespace mfem;
using namespace synovia;
using Catch::Contains;

namespace
{
/// Vectors of elements as a file has them, by their numbers.
std::string View(const std::string &name, int step,
                 const std::map<int, Point3> &vectors)
{
   std::string text = "$ElementData\n1\n\"" + name + "\"\n1\n0.5\n3\n" +
                      std::to_string(step) + "\n3\n" +
                      std::to_string(vectors.size()) + "\n";
   for (const auto &[number, vector] : vectors)
   {
      text += std::to_string(number);
      for (const real_t component : vector)
      {
         text += " " + ShortestNumber(component);
      }
      text += "\n";
   }
   return text + "$EndElementData\n";
}

NamedMesh ReadMesh(const std::string &text,
                   const ReadOptions &options = ReadOptions())
{
   const TemporaryDirectory directory;
   return ReadGmsh(directory.Write("mesh.msh", text), MPI_COMM_WORLD, options);
}

std::string ReadError(const std::string &text)
{
   try
   {
      ReadMesh(text);
   }
   catch (const Error &error)
   {
      return error.what();
   }
   return "";
}

/// Calls visit(center, axes, number of the element here) for each element of
/// this rank; the number of them on all ranks.
int ForEachElement(
   NamedMesh &mesh, const MaterialFrame &frame,
   const std::function<void(const Point3 &, const Tensor3<> &, int)> &visit)
{
   const int count = mesh.Get().GetNE();
   for (int i = 0; i < count; i++)
   {
      ElementTransformation &trans = *mesh.Get().GetElementTransformation(i);
      const IntegrationPoint &ip =
         Geometries.GetCenter(trans.GetGeometryType());
      trans.SetIntPoint(&ip);
      Vector x(3);
      trans.Transform(ip, x);
      visit({x[0], x[1], x[2]}, frame.GetAxes({trans, ip}), i);
   }
   int all = count;
   MPI_Allreduce(MPI_IN_PLACE, &all, 1, MPI_INT, MPI_SUM, mesh.GetComm());
   return all;
}

Point3 Column(const Tensor3<> &axes, int a)
{
   return {axes[0][a], axes[1][a], axes[2][a]};
}

// Right-handed and orthonormal.
void CheckAxes(const Tensor3<> &axes)
{
   const Point3 z = Cross(Column(axes, 0), Column(axes, 1));
   CHECK(Length(Column(axes, 1)) == Approx(1.0));
   CHECK(Length(z) == Approx(1.0));
   CHECK(Dot(z, Column(axes, 2)) == Approx(1.0));
}

// Six elements side by side in x, and the numbers that they have in the file.
MshText Row()
{
   return MshText(6, 1, 1);
}
constexpr int row_numbers[6] = {6, 11, 16, 21, 26, 32};

// A vector for those of them from number @a first on.
std::map<int, Point3> RowVectors(int first, const Point3 &vector)
{
   std::map<int, Point3> vectors;
   for (int i = first; i < 6; i++)
   {
      vectors[row_numbers[i]] = vector;
   }
   return vectors;
}

std::string CaseText(const std::string &file, const std::string &frame)
{
   return "mesh = {file = \"" + file +
          "\"}\n"
          "physics = {deformation = \"finite\"}\n"
          "boundary = [{surfaces = \"1\", displacement = [0, 0, 0]}]\n"
          "time = {end = 1, step = 1}\n"
          "[[material]]\n"
          "regions = \"10\"\n"
          "solid = {model = \"mixture\", solids = [{model = \"neo_hookean\", E "
          "= 1, nu = 0.2}, {model = \"fiber_nh\", mu = 2}]}\n"
          "permeability = {model = \"constant\", value = 1e-3}\n"
          "frame = " +
          frame + "\n";
}

std::string CaseError(const std::string &text, NamedMesh &mesh)
{
   try
   {
      CaseProblem(ParseCase(text, "case.toml"), mesh);
   }
   catch (const Error &error)
   {
      return error.what();
   }
   return "";
}
} // namespace

TEST_CASE("Vectors that gmsh saves are read", "[frames]")
{
   const std::string cells = GENERATE("tetrahedra", "hexahedra", "prisms");
   GmshFormat format;
   format.version = GENERATE(2.2, 4.1);
   format.binary = GENERATE(false, true);
   CAPTURE(cells, format.version, format.binary);
   NamedMesh mesh = ReadGmsh(GmshMesh("cylinder_" + cells + "_views", format),
                             MPI_COMM_WORLD);
   const FieldFrame frame(mesh, "around");
   const auto visit = [](const Point3 &x, const Tensor3<> &axes, int)
   {
      CheckAxes(axes);
      const Point3 around{{-x[1], x[0], 0.0}};
      CHECK(Dot(Column(axes, 1), around) ==
            Approx(Length(around)).epsilon(1e-9));
   };
   CHECK(ForEachElement(mesh, frame, visit) > 20);
   CHECK_THROWS_WITH(mesh.Vectors("round"),
                     "the mesh has no vectors of elements named \"round\"; "
                     "there are: around; did you mean \"around\"?");
   CHECK_THROWS_WITH(mesh.Vectors("number"), Contains("there are: around"));
}

TEST_CASE("Parts of a refined element have its vector", "[frames]")
{
   const std::string cells = GENERATE("tetrahedra", "hexahedra", "prisms");
   ReadOptions options;
   options.refine = 2;
   options.scale = 3.0;
   const std::string file = GmshMesh("cylinder_" + cells + "_views");
   NamedMesh coarse = ReadGmsh(file, MPI_COMM_WORLD);
   NamedMesh mesh = ReadGmsh(file, MPI_COMM_WORLD, options);
   const ElementVectors &vectors = mesh.Vectors("around");
   // The angle of a part's center is near that of the element's.
   real_t farthest = 0.0;
   const FieldFrame frame(mesh, "around");
   const int fine = ForEachElement(
      mesh, frame,
      [&](const Point3 &x, const Tensor3<> &, int i)
      {
         const Point3 from{{x[0] / 3.0 - vectors.vectors[i][1],
                            x[1] / 3.0 + vectors.vectors[i][0], 0.0}};
         farthest = std::max(farthest, Length(from));
      });
   const int before =
      ForEachElement(coarse, FieldFrame(coarse, "around"),
                     [](const Point3 &, const Tensor3<> &, int) {});
   CHECK(fine == 64 * before);
   CHECK(farthest < 0.7);
}

TEST_CASE("Of several steps the first counts, scalars are left out", "[frames]")
{
   const std::string number = "$ElementData\n1\n\"number\"\n0\n4\n0\n1\n2\n0\n"
                              "6 6\n11 11\n$EndElementData\n";
   NamedMesh mesh = ReadMesh(
      Row().Text() + number + View("fibers", 3, RowVectors(0, {{0, 2, 0}})) +
      View("fibers", 4, RowVectors(0, {{5, 5, 5}})) +
      View("fibers", 3, {{32, {{0, 0, -4}}}, {99, {{1, 0, 0}}}}));
   const FieldFrame frame(mesh, "fibers");
   const auto visit = [](const Point3 &x, const Tensor3<> &axes, int)
   {
      CheckAxes(axes);
      CHECK((x[0] < 5.0 ? axes[1][1] : -axes[2][1]) == 1.0);
   };
   CHECK(ForEachElement(mesh, frame, visit) == 6);
   CHECK_THROWS_WITH(FieldFrame(mesh, "number"), Contains("there are: fibers"));
}

TEST_CASE("Damaged vectors are errors with their place", "[frames]")
{
   const std::string text = Row().Text();
   const std::string view = View("fibers", 0, {{11, {{0, 2, 0}}}});
   const auto said = [&](const std::string &before, const std::string &after)
   {
      std::string changed = view;
      const size_t at = changed.find(before);
      REQUIRE(at != std::string::npos);
      changed.replace(at, before.size(), after);
      return ReadError(text + changed);
   };
   const std::string line = "11 0.0 2.0 0.0";
   CHECK_THAT(said(line, "11 0 x 0"),
              Contains("expected a number, found \"x\" (line "));
   CHECK_THAT(said(line, "11 0 inf 0"),
              Contains("the vector of element 11 in \"fibers\" is not finite"));
   CHECK_THAT(said("\"fibers\"", "fibers"),
              Contains("expected a name in quotes"));
   CHECK_THAT(said("3\n0\n3\n1\n", "2\n0\n3\n"),
              Contains("data of elements need a time step"));
   CHECK_THAT(said("3\n0\n3\n1\n", "3\n0\n3\n2\n"),
              Contains("expected a number, found \"$EndElementData\""));
   CHECK_THAT(said("$EndElementData\n", ""), Contains("the file is cut off"));
}

TEST_CASE("Elements without a vector are errors where one is needed",
          "[frames]")
{
   MshText file = Row();
   file.region = [](int i, int, int) { return i < 2 ? 10 : 11; };
   NamedMesh mesh =
      ReadMesh(file.Text() + View("fibers", 0, RowVectors(2, {{1, 0, 0}})));
   const std::string fibrous =
      CaseText("mesh.msh", "{type = \"field\", name = \"fibers\"}");
   const auto with_regions =
      [&](const std::string &ours, const std::string &others)
   {
      std::string text = fibrous;
      const std::string regions = "regions = \"10\"";
      text.replace(text.find(regions), regions.size(), "regions = " + ours);
      return others.empty()
                ? text
                : text + "[[material]]\nregions = " + others +
                     "\nsolid = {model = \"neo_hookean\", E = 1, nu "
                     "= 0.2}\npermeability = {model = "
                     "\"constant\", value = 1e-3}\n";
   };
   CHECK(CaseError(with_regions("\"11\"", "\"10\""), mesh) == "");
   for (const std::string &text : {with_regions("\"10\"", "\"11\""),
                                   with_regions("[\"11\", \"10\"]", "")})
   {
      CHECK_THAT(CaseError(text, mesh),
                 Contains("the mesh has no vector \"fibers\" for element 6, or "
                          "it is zero; each element of a region with this "
                          "frame needs one"));
   }
   std::string misspelt = with_regions("\"11\"", "\"10\"");
   misspelt.replace(misspelt.find("\"fibers\""), 8, "\"fibre\"");
   CHECK_THAT(CaseError(misspelt, mesh),
              Contains("case.toml:9:") &&
                 Contains("material.0.frame.name: the mesh has no vectors of "
                          "elements named \"fibre\"; there are: fibers"));
   // Where the permeability needs them, too.
   std::string permeable = with_regions("[\"11\", \"10\"]", "");
   const std::string constant = "{model = \"constant\", value = 1e-3}";
   permeable.replace(
      permeable.find(constant), constant.size(),
      "{model = \"referential_transversely_isotropic\", k0 = 1, k1T = 0, k1A = "
      "0, k2T = 0, k2A = 0, M0 = 0, MT = 0, MA = 0, alpha0 = 0, alphaT = 0, "
      "alphaA = 0}");
   const std::string fibers = ", {model = \"fiber_nh\", mu = 2}";
   permeable.replace(permeable.find(fibers), fibers.size(), "");
   CHECK_THAT(CaseError(permeable, mesh),
              Contains("no vector \"fibers\" for element 6"));
}

TEST_CASE("Directions are projected on the nearest surface", "[frames]")
{
   const Point3 direction{{0.3, -0.2, 1.0}};
   RoundOptions round;
   round.core = 2;
   round.shells = 4;
   round.order = GENERATE(1, 2);
   CAPTURE(round.order);
   const auto largest_error =
      [&](NamedMesh &mesh, const std::string &surface, bool ball, int &count)
   {
      const ProjectedFrame frame(mesh, mesh.Boundary(surface), direction);
      real_t error = 0.0;
      count = ForEachElement(
         mesh, frame,
         [&](const Point3 &x, const Tensor3<> &axes, int)
         {
            CheckAxes(axes);
            const Point3 out{{x[0], x[1], ball ? x[2] : 0.0}};
            const Point3 normal = Sum({0.0, 0.0, 0.0}, 1.0 / Length(out), out);
            const Point3 along =
               Sum(direction, -Dot(direction, normal), normal);
            const Point3 theta = Column(axes, 1);
            CHECK(std::abs(Dot(theta, Column(axes, 2))) < 1e-12);
            // Where little is left of the direction its angle says little.
            error = std::max({error, Length(Cross(Column(axes, 2), normal)),
                              Length(Cross(theta, along))});
            CHECK(Dot(Column(axes, 2), normal) > 0.0);
            CHECK(Dot(theta, along) > 0.0);
         });
      return MaxOverRanks(error, mesh.GetComm());
   };
   // At the rim, where a vertex has faces on one side only, the normal is off
   // by half the angle of a face, of which there are four in a quarter.
   constexpr real_t half_facet = M_PI / 16.0;
   real_t coarse[2];
   for (const int factor : {1, 2})
   {
      RoundOptions options = round;
      options.core *= factor;
      options.shells *= factor;
      NamedMesh cylinder = MakeQuarterCylinder(options);
      NamedMesh ball = MakeBallOctant(options);
      int elements = 0;
      const real_t errors[2] = {
         largest_error(cylinder, "side", false, elements),
         largest_error(ball, "surface", true, elements)};
      CHECK(elements > 50);
      for (int i = 0; i < 2; i++)
      {
         CAPTURE(i, factor, errors[i]);
         CHECK(errors[i] < (factor == 1 ? half_facet : 0.6 * coarse[i]));
         coarse[i] = errors[i];
      }
   }
}

TEST_CASE("A direction along the normal has no projection", "[frames]")
{
   BoxOptions box;
   box.nx = 3;
   NamedMesh mesh = MakeBox(box);
   const Array<int> top = mesh.Boundary("z1");
   const ProjectedFrame along(mesh, top, {{0.0, 0.0, -2.0}});
   const auto validate = [&](const Point3 &, const Tensor3<> &, int i)
   {
      CHECK_THAT(along.Validate(*mesh.Get().GetElementTransformation(i)),
                 Contains("along their normal at the element at ("));
   };
   CHECK(ForEachElement(mesh, along, validate) == 12);
   const ProjectedFrame oblique(mesh, top, {{-1.0, 0.0, 5.0}});
   const auto check = [&](const Point3 &, const Tensor3<> &axes, int i)
   {
      CHECK(oblique.Validate(*mesh.Get().GetElementTransformation(i)) == "");
      CheckAxes(axes);
      CHECK(axes[0][1] == Approx(-1.0));
      CHECK(axes[2][2] == Approx(1.0));
   };
   CHECK(ForEachElement(mesh, oblique, check) == 12);
   CHECK_THROWS_WITH(ProjectedFrame(mesh, top, {{0.0, 0.0, 0.0}}),
                     Contains("is zero; give a vector"));
}

TEST_CASE("Frames of elements in case files", "[frames]")
{
   NamedMesh mesh = ReadMesh(Row().Text());
   const auto said = [&](const std::string &frame)
   { return CaseError(CaseText("mesh.msh", frame), mesh); };
   CHECK_THAT(said("{type = \"field\"}"),
              Contains("material.0.frame.name: this is missing (of the vectors "
                       "in the mesh file ($ElementData of gmsh), along which "
                       "fibers run in each element)"));
   CHECK_THAT(said("{type = \"field\", name = \"\"}"),
              Contains("material.0.frame.name: the name is empty"));
   CHECK_THAT(said("{type = \"field\", name = \"x\"}"),
              Contains("material.0.frame.name: the mesh has no vectors of "
                       "elements named \"x\"; it has none"));
   CHECK_THAT(said("{name = \"x\"}"),
              Contains("case.toml:9:10: material.0.frame.name: this goes with "
                       "\"field\", not with \"cartesian\""));
   CHECK_THAT(said("{origin = [0, 0, 0]}"),
              Contains("material.0.frame.origin: this goes with "
                       "\"cylindrical\", not with \"cartesian\""));
   CHECK_THAT(said("{type = \"cylindrical\", orign = [0, 0, 0]}"),
              Contains("did you mean \"origin\"?"));
   CHECK_THAT(said("{type = \"field\", name = \"x\", axis = [1, 0, 0]}"),
              Contains("material.0.frame.axis: this goes with \"cartesian\" or "
                       "\"cylindrical\", not with \"field\""));
   CHECK_THAT(said("{type = \"projected\"}"),
              Contains("material.0.frame.direction: this is missing") &&
                 Contains("material.0.frame.surfaces: this is missing"));
   CHECK_THAT(
      said("{type = \"projected\", direction = [0, 0, 1], surfaces = [\"a\"]}"),
      Contains("material.0.frame.surfaces.0: no boundary is named \"a\""));
   CHECK_THAT(said("{type = \"cylindrical\", surfaces = [\"1\"]}"),
              Contains("material.0.frame.surfaces: this goes with "
                       "\"projected\", not with \"cylindrical\""));
   CHECK_THAT(said("{type = \"feild\"}"),
              Contains("expected \"cartesian\", \"cylindrical\", \"field\" or "
                       "\"projected\"; did you mean \"field\"?"));
}
