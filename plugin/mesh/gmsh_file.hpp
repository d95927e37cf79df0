#pragma once

#include "synovia/mesh/flat_mesh.hpp"

#include <string>

namespace synovia
{

/// Reads a gmsh mesh on the calling rank alone; see ReadGmsh() for the
/// treatment of its elements. Throws Error, whose text does not name the file.
FlatMesh ReadGmshFile(const std::string &path);

} // namespace synovia
