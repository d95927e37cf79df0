#pragma once

#include "mfem.hpp"

#include "synovia/mesh/flat_mesh.hpp"

#include <array>
#include <vector>

namespace synovia
{

/// Vertices of a face in ascending order; -1 is the fourth of a triangle.
using FaceKey = std::array<int, 4>;

/// Key of a face whose vertices are in any order, -1 for the fourth of a
/// triangle.
FaceKey MakeFaceKey(std::array<int, 4> vertices);

/// A face as one of its elements has it.
struct FaceSide
{
   FaceKey key;
   int element;
   /// Number of the face in the element.
   int face;
};

/// The order of the keys.
inline bool ComesBefore(const FaceSide &a, const FaceSide &b)
{
   return a.key < b.key;
}

/// The first node of each element in FlatMesh::element_nodes.
std::vector<int> FirstNodes(const FlatMesh &mesh);

/// Vertices of an element's face as seen from outside the element, if it is
/// numbered right-handed; -1 is the fourth of a triangle. @a nodes are the
/// element's.
std::array<int, 4> FaceVertices(mfem::Geometry::Type geometry, const int *nodes,
                                int face);

/// The faces of all elements, those with the same vertices side by side.
/// Throws Error if more than two elements share a face, or if two faces share
/// three corners but not the fourth, such as those of a hexahedron and a
/// tetrahedron with no pyramid between them.
std::vector<FaceSide> SortedFaceSides(const FlatMesh &mesh);

} // namespace synovia
