#pragma once

#include "mfem.hpp"

#include <string>
#include <vector>

namespace synovia
{

/// One of gmsh's element types, with nodes in gmsh's order: the corners first.
struct GmshElementType
{
   /// Such as "Hexahedron 20".
   std::string name;
   mfem::Geometry::Type geometry = mfem::Geometry::INVALID;
   int dimension = -1;
   int order = 0;
   int nodes = 0;
   int corners = 0;
   /// Whether nodes within faces and elements are left out; those that there
   /// are come first among the nodes of the complete type.
   bool serendipity = false;
};

/// A type by its number in a file; with 0 nodes if it is not supported, as
/// incomplete ones above order 2 aren't.
const GmshElementType &GmshType(int number);

/// For each point of the lattice of a complete volume element, x running first
/// and z last, the place of its node in gmsh's order.
std::vector<int> GmshNodesOfLattice(mfem::Geometry::Type geometry, int order);

} // namespace synovia
