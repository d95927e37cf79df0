#pragma once

#include "mfem.hpp"

#include "synovia/general/point3.hpp"
#include "synovia/mesh/named_mesh.hpp"

#include <array>
#include <vector>

namespace synovia
{

/// An element type of a mesh file: its geometry and how its nodes span its map.
///
/// The corners come first among the nodes, in MFEM's order.
struct ElementShape
{
   mfem::Geometry::Type geometry = mfem::Geometry::INVALID;
   int order = 1;
   int nodes = 0;
   /// Values of the functions of all nodes at the nodal points of MFEM's H1
   /// element of the mesh's order, point after point. Empty in a mesh of
   /// order 1.
   std::vector<double> basis;
};

/// A volume mesh in flat arrays, as a file has it.
struct FlatMesh
{
   /// The highest order of the shapes.
   int order = 1;
   std::vector<ElementShape> shapes;
   /// x, y, z of each node.
   std::vector<double> coordinates;
   /// The first so many nodes are vertices, the others shape curved elements.
   int vertices = 0;
   /// Numbers of the vertices in the file.
   std::vector<long long> vertex_numbers;

   /// Of each element: its shape, its attribute and its number in the file.
   std::vector<int> element_shapes;
   std::vector<int> element_attributes;
   std::vector<long long> element_numbers;
   /// Nodes of the elements, one element after the other.
   std::vector<int> element_nodes;
   /// By name, a vector of each element; zero where the file has none.
   std::map<std::string, std::vector<Point3>> element_vectors;

   /// Vertices of the outer faces, as seen from outside; -1 is the fourth of a
   /// triangle.
   std::vector<std::array<int, 4>> faces;
   std::vector<int> face_attributes;

   NameTable regions;
   NameTable boundaries;
};

/// Collective. Gives every rank the tables of names that rank 0 has, and the
/// names of its vectors.
void BroadcastNames(FlatMesh &mesh, MPI_Comm comm);

/// The mesh for MFEM, with curved nodes if its order is above 1. Throws Error
/// if curved elements do not fit together.
mfem::Mesh BuildMesh(const FlatMesh &flat);

} // namespace synovia
