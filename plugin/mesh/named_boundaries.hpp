#pragma once

#include "synovia/mesh/named_mesh.hpp"

#include <string>
#include <vector>

namespace synovia
{

/// The attributes of several boundaries, ascending, each once. Throws Error if
/// the mesh has no boundary of one of the names.
mfem::Array<int> NamedBoundaries(const NamedMesh &mesh,
                                 const std::vector<std::string> &names);

} // namespace synovia
