#include "synovia/mesh/face_sides.hpp"
#include "synovia/general/error.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

namespace
{

template <typename Constants>
std::array<int, 4> CornersOf(int face)
{
   std::array<int, 4> corners = {-1, -1, -1, -1};
   std::copy(std::begin(Constants::FaceVert[face]),
             std::end(Constants::FaceVert[face]), corners.begin());
   return corners;
}

std::string Number(const FlatMesh &mesh, const FaceSide &side)
{
   return std::to_string(mesh.element_numbers[side.element]);
}

[[noreturn]] void ThrowOverlap(const FlatMesh &mesh, const FaceSide &a,
                               const FaceSide &b)
{
   throw Error("the elements " + Number(mesh, a) + " and " + Number(mesh, b) +
               " share three corners of a face but not the face; hexahedra and "
               "prisms need pyramids towards tetrahedra");
}

// Throws if there is a triangle of three corners of a quadrangle.
void CheckTriangles(const FlatMesh &mesh, const std::vector<FaceSide> &sides,
                    const FaceSide &quadrangle)
{
   for (int left_out = 0; left_out < 4; left_out++)
   {
      FaceSide triangle = quadrangle;
      std::swap(triangle.key[left_out], triangle.key[3]);
      triangle.key[3] = -1;
      triangle.key = MakeFaceKey(triangle.key);
      const auto found =
         std::lower_bound(sides.begin(), sides.end(), triangle, ComesBefore);
      if (found != sides.end() && found->key == triangle.key)
      {
         ThrowOverlap(mesh, quadrangle, *found);
      }
   }
}

void CheckSides(const FlatMesh &mesh, const std::vector<FaceSide> &sides)
{
   for (size_t i = 0; i < sides.size(); i++)
   {
      const FaceKey &key = sides[i].key;
      const bool again = i > 0 && sides[i - 1].key == key;
      if (again && i > 1 && sides[i - 2].key == key)
      {
         throw Error("the elements " + Number(mesh, sides[i - 2]) + ", " +
                     Number(mesh, sides[i - 1]) + " and " +
                     Number(mesh, sides[i]) + " share one face");
      }
      // MFEM knows a quadrangle by its three lowest vertices.
      if (i > 0 && !again &&
          std::equal(key.begin(), key.begin() + 3, sides[i - 1].key.begin()))
      {
         ThrowOverlap(mesh, sides[i - 1], sides[i]);
      }
      if (key[3] >= 0 && !again)
      {
         CheckTriangles(mesh, sides, sides[i]);
      }
   }
}

} // namespace

FaceKey MakeFaceKey(std::array<int, 4> vertices)
{
   std::sort(vertices.begin(), vertices.begin() + (vertices[3] < 0 ? 3 : 4));
   return vertices;
}

std::vector<int> FirstNodes(const FlatMesh &mesh)
{
   std::vector<int> first;
   int next = 0;
   for (const int shape : mesh.element_shapes)
   {
      first.push_back(next);
      next += mesh.shapes[shape].nodes;
   }
   return first;
}

std::array<int, 4> FaceVertices(Geometry::Type geometry, const int *nodes,
                                int face)
{
   std::array<int, 4> vertices = {-1, -1, -1, -1};
   switch (geometry)
   {
   case Geometry::TETRAHEDRON:
      vertices = CornersOf<Geometry::Constants<Geometry::TETRAHEDRON>>(face);
      break;
   case Geometry::CUBE:
      vertices = CornersOf<Geometry::Constants<Geometry::CUBE>>(face);
      break;
   case Geometry::PRISM:
      vertices = CornersOf<Geometry::Constants<Geometry::PRISM>>(face);
      break;
   case Geometry::PYRAMID:
      vertices = CornersOf<Geometry::Constants<Geometry::PYRAMID>>(face);
      break;
   default:
      MFEM_ABORT("no volume element: geometry " << geometry);
   }
   for (int &vertex : vertices)
   {
      vertex = vertex < 0 ? -1 : nodes[vertex];
   }
   return vertices;
}

std::vector<FaceSide> SortedFaceSides(const FlatMesh &mesh)
{
   const std::vector<int> first = FirstNodes(mesh);
   const int elements = static_cast<int>(first.size());
   std::vector<FaceSide> sides;
   for (int i = 0; i < elements; i++)
   {
      const Geometry::Type geometry =
         mesh.shapes[mesh.element_shapes[i]].geometry;
      for (int face = 0; face < Geometry::NumFaces[geometry]; face++)
      {
         const int *const nodes = mesh.element_nodes.data() + first[i];
         const auto vertices = FaceVertices(geometry, nodes, face);
         sides.push_back({MakeFaceKey(vertices), i, face});
      }
   }
   std::sort(sides.begin(), sides.end(),
             [](const FaceSide &a, const FaceSide &b) {
                return a.key != b.key ? a.key < b.key : a.element < b.element;
             });
   CheckSides(mesh, sides);
   return sides;
}

} // namespace synovia
