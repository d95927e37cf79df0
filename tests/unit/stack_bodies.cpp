// Bodies merged into one mesh stay what they were.

// ranks: 1 2

#include "synovia/mesh/stack_bodies.hpp"
#include "support/mesh_measures.hpp"
#include "synovia/general/error.hpp"
#include "synovia/mesh/named_mesh.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{

Mesh Cube(Element::Type type, real_t shift)
{
   Mesh cube = Mesh::MakeCartesian3D(2, 2, 2, type);
   cube.Transform(
      [shift](const Vector &x, Vector &y)
      {
         y = x;
         y(2) += shift;
      });
   return cube;
}

// With a bulge on the top, of the given order.
Mesh CurvedCube(Element::Type type, int order, bool discontinuous)
{
   Mesh cube = Cube(type, 0.0);
   cube.SetCurvature(order, discontinuous);
   cube.Transform(
      [](const Vector &x, Vector &y)
      {
         y = x;
         y(2) *= 1.0 + 0.3 * x(0) * (1.0 - x(0));
      });
   return cube;
}

real_t Volume(Mesh &mesh)
{
   real_t volume = 0.0;
   for (int i = 0; i < mesh.GetNE(); i++)
   {
      volume += mesh.GetElementVolume(i);
   }
   return volume;
}

} // namespace

TEST_CASE("stack bodies: offsets and attributes")
{
   const Mesh lower = Cube(Element::HEXAHEDRON, 0.0);
   const Mesh upper = Cube(Element::TETRAHEDRON, 1.0);
   StackedBodies stack = StackBodies({&lower, &upper, &lower});
   CHECK(stack.region_offsets == std::vector<int>{0, 1, 2});
   CHECK(stack.boundary_offsets == std::vector<int>{0, 6, 12});
   CHECK(stack.mesh.GetNE() == 2 * lower.GetNE() + upper.GetNE());
   CHECK(stack.mesh.GetNV() == 3 * lower.GetNV());
   CHECK(stack.mesh.GetNBE() == 2 * lower.GetNBE() + upper.GetNBE());
   CHECK(stack.mesh.attributes.Max() == 3);
   CHECK(stack.mesh.bdr_attributes.Size() == 18);
   CHECK(stack.mesh.GetNodes() == nullptr);

   const NamedMesh mesh = DistributeMesh(
      stack.mesh, {{"lower", {1}}, {"upper", {2}}},
      {{"lower_top", {6}}, {"upper_bottom", {7}}}, MPI_COMM_WORLD);
   CHECK(RegionVolume(mesh, "lower") == Approx(1.0));
   CHECK(RegionVolume(mesh, "upper") == Approx(1.0));
   CHECK(BoundaryArea(mesh, "lower_top") == Approx(1.0));
   CHECK(BoundaryArea(mesh, "upper_bottom") == Approx(1.0));
}

// A straight body takes on the nodes of the curved ones.
TEST_CASE("stack bodies: curvature is kept")
{
   const bool discontinuous = GENERATE(false, true);
   Mesh curved = CurvedCube(Element::WEDGE, 3, discontinuous);
   Mesh quadratic = CurvedCube(Element::TETRAHEDRON, 2, false);
   Mesh straight = Cube(Element::HEXAHEDRON, 3.0);
   StackedBodies stack = StackBodies({&straight, &curved, &quadratic});
   REQUIRE(stack.mesh.GetNodes());
   CHECK(stack.mesh.GetNodes()->FESpace()->GetMaxElementOrder() == 3);
   CHECK(stack.mesh.GetNodes()->FESpace()->IsDGSpace() == discontinuous);
   CHECK(Volume(stack.mesh) == Approx(Volume(curved) + Volume(quadratic) + 1));
   // The bulge adds 0.3 / 6, which order 2 has exactly.
   CHECK(Volume(quadratic) == Approx(1.05));

   // Refinement splits what it would have split in the bodies.
   stack.mesh.UniformRefinement();
   quadratic.UniformRefinement();
   CHECK(Volume(stack.mesh) == Approx(3.1));
   const NamedMesh mesh = DistributeMesh(stack.mesh, {}, {}, MPI_COMM_WORLD);
   CHECK(RegionVolume(mesh, "3") == Approx(1.05));
}

TEST_CASE("stack bodies: errors")
{
   const Mesh cube = Cube(Element::WEDGE, 0.0);
   const Mesh square = Mesh::MakeCartesian2D(1, 1, Element::TRIANGLE);
   CHECK_THROWS_WITH(StackBodies({}), "there are no bodies to stack");
   CHECK_THROWS_WITH(StackBodies({&cube, &square}),
                     "body 1 is not three-dimensional");
   Mesh hanging = Cube(Element::HEXAHEDRON, 0.0);
   hanging.EnsureNCMesh();
   CHECK_THROWS_AS(StackBodies({&hanging}), Error);
}
