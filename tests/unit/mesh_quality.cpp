// The quality of meshes whose elements are known.

// ranks: 1 2 3

#include "synovia/mesh/mesh_quality.hpp"
#include "synovia/mesh/named_mesh.hpp"
#include "synovia/mesh/stack_bodies.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{

// One element with the given corners.
Mesh OneElement(Geometry::Type geometry, const std::vector<double> &corners)
{
   const int number = static_cast<int>(corners.size()) / 3;
   Mesh mesh(3, number, 1);
   std::vector<int> vertices;
   for (int i = 0; i < number; i++)
   {
      mesh.AddVertex(corners[3 * i], corners[3 * i + 1], corners[3 * i + 2]);
      vertices.push_back(i);
   }
   Element *const element = mesh.NewElement(geometry);
   element->SetVertices(vertices.data());
   mesh.AddElement(element);
   mesh.FinalizeTopology();
   mesh.Finalize();
   return mesh;
}

const double h = std::sqrt(3.0) / 2;
const double peak = std::sqrt(2.0 / 3.0);

} // namespace

TEST_CASE("mesh quality: regular elements have 1")
{
   const Mesh tetrahedron = OneElement(
      Geometry::TETRAHEDRON, {0, 0, 0, 1, 0, 0, 0.5, h, 0, 0.5, h / 3, peak});
   const Mesh prism =
      OneElement(Geometry::PRISM,
                 {0, 0, 0, 1, 0, 0, 0.5, h, 0, 0, 0, 1, 1, 0, 1, 0.5, h, 1});
   const Mesh pyramid =
      OneElement(Geometry::PYRAMID, {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.5,
                                     0.5, std::sqrt(0.5)});
   const Mesh cube = Mesh::MakeCartesian3D(1, 1, 1, Element::HEXAHEDRON);
   for (const Mesh *mesh : {&tetrahedron, &prism, &pyramid, &cube})
   {
      Mesh curved(*mesh);
      curved.SetCurvature(2);
      CHECK(ScaledJacobians(*mesh)(0) == Approx(1.0));
      CHECK(ScaledJacobians(curved)(0) == Approx(1.0));
   }
}

TEST_CASE("mesh quality: known shapes")
{
   // The corner tetrahedron of a cube: sqrt(2)/2 at the long edges.
   const Mesh corner =
      OneElement(Geometry::TETRAHEDRON, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1});
   CHECK(ScaledJacobians(corner)(0) == Approx(std::sqrt(2.0) / 2));

   // Sheared to 45 degrees: sin 45.
   Mesh sheared = Mesh::MakeCartesian3D(1, 1, 1, Element::HEXAHEDRON);
   sheared.Transform(
      [](const Vector &x, Vector &y)
      {
         y = x;
         y(0) += x(1);
      });
   CHECK(ScaledJacobians(sheared)(0) == Approx(std::sqrt(0.5)));

   // Stretching does not count.
   const Mesh flat =
      Mesh::MakeCartesian3D(1, 1, 1, Element::HEXAHEDRON, 1.0, 1.0, 0.01);
   CHECK(ScaledJacobians(flat)(0) == Approx(1.0));

   // A dent in the middle of an edge, which the corners do not have.
   Mesh dented = Mesh::MakeCartesian3D(1, 1, 1, Element::HEXAHEDRON);
   dented.SetCurvature(2);
   dented.Transform(
      [](const Vector &x, Vector &y)
      {
         y = x;
         y(2) += 4.0 * x(2) * x(0) * (1.0 - x(0)) * (x(2) - 1.0) * 1.2;
      });
   CHECK(ScaledJacobians(dented)(0) < 0.0);
}

TEST_CASE("mesh quality: over all ranks")
{
   Mesh good = Mesh::MakeCartesian3D(2, 2, 2, Element::HEXAHEDRON);
   Mesh bad = Mesh::MakeCartesian3D(1, 1, 1, Element::HEXAHEDRON);
   bad.Transform(
      [](const Vector &x, Vector &y)
      {
         y = x;
         y(0) += x(1) + 5.0;
      });
   Mesh stack = StackBodies({&good, &bad}).mesh;
   const NamedMesh mesh = DistributeMesh(stack, {}, {}, MPI_COMM_WORLD);
   const MeshQuality quality = MeasureQuality(mesh.Get());
   CHECK(quality.elements == 9);
   CHECK(quality.min_scaled_jacobian == Approx(std::sqrt(0.5)));
   CHECK(quality.median_scaled_jacobian == Approx(1.0));
   CHECK(quality.worst_attribute == 2);
   CHECK(quality.worst_center[0] == Approx(6.0));
   CHECK(quality.worst_center[2] == Approx(0.5));
   CHECK(quality.shortest_edge == Approx(0.5));
   CHECK(quality.longest_edge == Approx(std::sqrt(2.0)));
   CHECK(quality.volume == Approx(2.0));
}
