#pragma once

#include "synovia/mesh/curved_layers.hpp"
#include "synovia/mesh/mesh_share.hpp"

namespace synovia
{

/// Collective. This rank's share of two layers of hexahedra, before they are
/// split: the upper one has element attribute 2, and boundary attributes 7 to
/// 12 where the lower one has 1 to 6, for z0, y0, x1, y1, x0, z1. Each rank
/// makes its own elements and those around them; rank 0 knows of the others
/// only where in the grid they are and whose. Throws Error where there are more
/// ranks than elements.
MeshShare MakeHexLayerShare(const LayersOptions &options, MPI_Comm comm);

} // namespace synovia
