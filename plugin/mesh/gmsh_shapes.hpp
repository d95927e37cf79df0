#pragma once

#include "synovia/mesh/gmsh_element_types.hpp"

#include <vector>

namespace synovia
{

/// For each node of a volume element type, the node at its mirror image; a
/// left-handed element becomes right-handed when its nodes are taken in this
/// order.
std::vector<int> MirroredNodes(const GmshElementType &type);

/// Values of the functions of a volume element type's nodes at the nodal points
/// of MFEM's H1 element of an order, as ElementShape::basis has them.
std::vector<double> BasisAtNodalPoints(const GmshElementType &type, int order);

} // namespace synovia
