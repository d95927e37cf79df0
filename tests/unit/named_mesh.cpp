// Names of regions and boundaries, and what DistributeMesh() looks at.

// ranks: 1 2 3

#include "synovia/mesh/named_mesh.hpp"
#include "support/mesh_measures.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/suggestion.hpp"
#include "synovia/mesh/stack_bodies.hpp"

#include <catch2/catch.hpp>

using namespace mfem;
using namespace synovia;

namespace
{

// The unit cube; MFEM numbers its sides from 1: z0, y0, x1, y1, x0, z1.
Mesh Cube(int n, Element::Type type = Element::HEXAHEDRON)
{
   return Mesh::MakeCartesian3D(n, n, n, type, 1.0, 1.0, 1.0, false);
}

NamedMesh NamedCube()
{
   Mesh cube = Cube(2);
   return DistributeMesh(cube, {{"cartilage", {1}}},
                         {{"bone", {1}},
                          {"cartilage_top", {6}},
                          {"rim", {5, 2, 3, 4, 4}},
                          {"all", {1, 2, 3, 4, 5, 6}},
                          {"nothing", {}}},
                         MPI_COMM_WORLD);
}

std::vector<int> List(const Array<int> &array)
{
   return std::vector<int>(array.begin(), array.end());
}

int Ranks()
{
   int ranks = 1;
   MPI_Comm_size(MPI_COMM_WORLD, &ranks);
   return ranks;
}

} // namespace

TEST_CASE("named mesh: attributes of names")
{
   const NamedMesh mesh = NamedCube();
   CHECK(List(mesh.Region("cartilage")) == std::vector<int>{1});
   CHECK(List(mesh.Boundary("bone")) == std::vector<int>{1});
   CHECK(List(mesh.Boundary("rim")) == std::vector<int>{2, 3, 4, 5});
   CHECK(List(mesh.Boundary("4")) == std::vector<int>{4});
   CHECK(List(mesh.Region("1")) == std::vector<int>{1});
   CHECK(BoundaryArea(mesh, "rim") == Approx(4.0));
   CHECK(NameOf(mesh.Boundaries(), 6) == "all/cartilage_top");
   CHECK(NameOf(mesh.Boundaries(), 9) == "9");
}

TEST_CASE("named mesh: MFEM knows the names as well")
{
   NamedMesh named = NamedCube();
   ParMesh &mesh = named.Get();
   CHECK(List(mesh.attribute_sets.GetAttributeSet("cartilage")) ==
         std::vector<int>{1});
   CHECK(List(mesh.bdr_attribute_sets.GetAttributeSet("rim")) ==
         std::vector<int>{2, 3, 4, 5});
}

TEST_CASE("named mesh: unknown names")
{
   const NamedMesh mesh = NamedCube();
   const std::string known = "; there are: all, bone, cartilage_top, rim";
   CHECK_THROWS_WITH(mesh.Boundary("bnoe"), "no boundary is named \"bnoe\"" +
                                               known +
                                               "; did you mean \"bone\"?");
   CHECK_THROWS_WITH(mesh.Boundary("femur"),
                     "no boundary is named \"femur\"" + known);
   CHECK_THROWS_WITH(mesh.Boundary(""), "no boundary is named \"\"" + known);
   CHECK_THROWS_WITH(mesh.Boundary("7"), "no boundary is named \"7\"" + known);
   CHECK_THROWS_WITH(mesh.Boundary("-1"),
                     "no boundary is named \"-1\"" + known);
   CHECK_THROWS_WITH(mesh.Boundary("99999999999999"),
                     Catch::StartsWith("no boundary is named"));
   CHECK_THROWS_WITH(mesh.Boundary("nothing"),
                     "the boundary \"nothing\" is empty: none of its faces is "
                     "on the outside of the mesh (bodies that touch need "
                     "nodes of their own)" +
                        known);
   CHECK_THROWS_WITH(mesh.Region("Cartilage"),
                     "no region is named \"Cartilage\"; there are: cartilage; "
                     "did you mean \"cartilage\"?");
   CHECK_THROWS_AS(mesh.Region("bone"), Error);
}

// Attributes without a name are listed by their number.
TEST_CASE("named mesh: attributes without names")
{
   Mesh cube = Cube(2);
   const NamedMesh mesh =
      DistributeMesh(cube, {}, {{"top", {6}}}, MPI_COMM_WORLD);
   CHECK_THROWS_WITH(mesh.Region("a"),
                     "no region is named \"a\"; there are: 1");
   CHECK_THROWS_WITH(mesh.Boundary("a"),
                     "no boundary is named \"a\"; there are: top, 1, 2, 3, 4, "
                     "5");
   CHECK(BoundaryArea(mesh, "3") == Approx(1.0));
}

TEST_CASE("named mesh: suggestions")
{
   const std::vector<std::string> names = {"bone", "tibia", "tibial_plateau"};
   CHECK(Suggest("bnoe", names) == "bone");
   CHECK(Suggest("Bone", names) == "bone");
   CHECK(Suggest("bones", names) == "bone");
   CHECK(Suggest("tibal_platau", names) == "tibial_plateau");
   CHECK(Suggest("tbi", names) == "");
   CHECK(Suggest("x", names) == "");
   CHECK(Suggest("", names) == "");
}

TEST_CASE("distribute mesh: every element is on one rank")
{
   const Element::Type type =
      GENERATE(Element::HEXAHEDRON, Element::TETRAHEDRON, Element::WEDGE);
   Mesh cube = Cube(3, type);
   const long long elements = cube.GetNE();
   const NamedMesh mesh =
      DistributeMesh(cube, {{"cube", {1}}}, {{"top", {6}}}, MPI_COMM_WORLD);
   CHECK(mesh.Get().GetNE() > 0);
   CHECK(mesh.Get().GetGlobalNE() == elements);
   CHECK(RegionVolume(mesh, "cube") == Approx(1.0));
   CHECK(BoundaryArea(mesh, "top") == Approx(1.0));
}

TEST_CASE("distribute mesh: a given partitioning")
{
   Mesh cube = Cube(3);
   std::vector<int> partitioning(cube.GetNE());
   for (int i = 0; i < cube.GetNE(); i++)
   {
      partitioning[i] = i % Ranks();
   }
   const NamedMesh mesh = DistributeMesh(cube, {{"cube", {1}}}, {},
                                         MPI_COMM_WORLD, partitioning.data());
   int rank = 0;
   MPI_Comm_rank(MPI_COMM_WORLD, &rank);
   CHECK(mesh.Get().GetNE() == (27 + Ranks() - 1 - rank) / Ranks());
   CHECK(RegionVolume(mesh, "cube") == Approx(1.0));

   partitioning[20] = Ranks();
   CHECK_THROWS_WITH(DistributeMesh(cube, {{"cube", {1}}}, {}, MPI_COMM_WORLD,
                                    partitioning.data()),
                     "the partitioning gives element 20 to rank " +
                        std::to_string(Ranks()) + "; the ranks are 0 to " +
                        std::to_string(Ranks() - 1));
}

TEST_CASE("distribute mesh: bodies that do not touch")
{
   const Mesh a = Cube(2);
   const Mesh b = Cube(1);
   const Mesh c = Cube(2, Element::WEDGE);
   Mesh stack = StackBodies({&a, &b, &c}).mesh;
   const NamedMesh mesh = DistributeMesh(
      stack, {{"a", {1}}, {"b", {2}}, {"c", {3}}}, {}, MPI_COMM_WORLD);
   CHECK(RegionVolume(mesh, "a") == Approx(1.0));
   CHECK(RegionVolume(mesh, "b") == Approx(1.0));
   CHECK(RegionVolume(mesh, "c") == Approx(1.0));
}

TEST_CASE("distribute mesh: errors")
{
   const auto distribute =
      [](Mesh mesh, const NameTable &regions, const NameTable &boundaries)
   { DistributeMesh(mesh, regions, boundaries, MPI_COMM_WORLD); };
   CHECK_THROWS_WITH(
      distribute(Mesh::MakeCartesian2D(4, 4, Element::TRIANGLE), {}, {}),
      "the mesh is 2-dimensional; a three-dimensional one is needed");
   CHECK_THROWS_WITH(distribute(Cube(2), {{"bone", {1, 2}}}, {}),
                     "the region \"bone\" stands for attribute 2, which no "
                     "region element of the mesh has");
   CHECK_THROWS_WITH(distribute(Cube(2), {}, {{"top", {7}}}),
                     "the boundary \"top\" stands for attribute 7, which no "
                     "boundary element of the mesh has");
   if (Ranks() > 1)
   {
      CHECK_THROWS_WITH(distribute(Cube(1), {}, {}),
                        "there are " + std::to_string(Ranks()) +
                           " ranks and only 1 elements; use fewer ranks or "
                           "refine the mesh");
   }
}

TEST_CASE("distribute mesh: tangled elements")
{
   const Element::Type type =
      GENERATE(Element::HEXAHEDRON, Element::TETRAHEDRON, Element::WEDGE);
   Mesh cube = Cube(2, type);
   const auto distribute = [](Mesh &mesh) {
      DistributeMesh(mesh, {{"cartilage", {1}}}, {}, MPI_COMM_WORLD);
   };
   distribute(cube);

   // The middle is pulled out of the cube.
   for (int i = 0; i < cube.GetNV(); i++)
   {
      real_t *const vertex = cube.GetVertex(i);
      if (vertex[0] == 0.5 && vertex[1] == 0.5 && vertex[2] == 0.5)
      {
         vertex[2] = 1.25;
      }
   }
   const auto check = [&](Mesh &mesh)
   {
      CHECK_THROWS_WITH(distribute(mesh),
                        Catch::Contains(" elements are tangled (the Jacobian "
                                        "determinant is not positive "
                                        "everywhere); the first is element ") &&
                           Catch::Contains(" in region \"cartilage\", around "
                                           "("));
   };
   check(cube);
   if (type == Element::HEXAHEDRON)
   {
      CHECK_THROWS_WITH(distribute(cube),
                        Catch::StartsWith("4 elements are tangled") &&
                           Catch::Contains("the first is element 4 in"));
   }

   Mesh mirrored = Cube(2, type);
   mirrored.Transform(
      [](const Vector &x, Vector &y)
      {
         y = x;
         y(0) = -x(0);
      });
   CHECK_THROWS_WITH(
      distribute(mirrored),
      Catch::StartsWith(std::to_string(mirrored.GetNE()) + " elements are"));

   Mesh flat = Cube(2, type);
   flat.Transform(
      [](const Vector &x, Vector &y)
      {
         y = x;
         y(2) = 0.3 * x(0);
      });
   check(flat);
}

// Corners alone do not tell: a curved element may fold between them.
TEST_CASE("distribute mesh: folded curved elements")
{
   Mesh cube = Cube(2);
   cube.SetCurvature(2);
   const auto fold = [](real_t amount)
   {
      return [amount](const Vector &x, Vector &y)
      {
         y = x;
         y(0) += amount * 16.0 * x(0) * (0.5 - x(0)) * (1.0 - x(0));
      };
   };
   Mesh bent(cube);
   bent.Transform(fold(0.05));
   CHECK_NOTHROW(DistributeMesh(bent, {}, {}, MPI_COMM_WORLD));
   Mesh folded(cube);
   folded.Transform(fold(0.5));
   CHECK_THROWS_AS(DistributeMesh(folded, {}, {}, MPI_COMM_WORLD), Error);
}
