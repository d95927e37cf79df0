#pragma once

#include "mfem.hpp"

namespace synovia
{

/// MFEM's marker of some boundary attributes: 1 at the place of each, 0
/// elsewhere. Throws Error on all ranks, which names the attribute and those
/// that there are, if the mesh has none of that number.
mfem::Array<int> BoundaryMarker(const mfem::ParMesh &mesh,
                                const mfem::Array<int> &attributes);

} // namespace synovia
