#pragma once

#include "mesh/flat_mesh.hpp"
#include "mesh/gmsh_element_types.hpp"

#include <vector>

namespace synovia
{

/// The geometry of a volume element type of gmsh; INVALID for other types.
mfem::Geometry::Type GeometryOf(const GmshElementType &type);

/// Reference coordinates in gmsh's element, u, v, w each, of points of MFEM's.
/// Corners go to corners: gmsh's hexahedra and pyramids extend from -1 to 1,
/// prisms from -1 to 1 in w only.
std::vector<double> ToGmsh(const GmshElementType &type,
                           const mfem::IntegrationRule &points);

/// For each node of a type, the node at its mirror image; a left-handed element
/// becomes right-handed when its nodes are taken in this order.
std::vector<int> MirroredNodes(const GmshElementType &type);

/// Values of the functions of gmsh's type @a number at the nodal points of
/// MFEM's H1 element of an order, as ElementShape::basis has them. Throws Error
/// if gmsh does not have the functions of this type.
std::vector<double> BasisAtNodalPoints(GmshElementTypes &types, int number,
                                       int order);

} // namespace synovia
