#pragma once

#include "synovia/mesh/flat_mesh.hpp"

#include <string>

namespace synovia
{

/// Reads a gmsh mesh on the calling rank alone; what becomes of its elements is
/// told at ReadGmsh(). Throws Error, whose text does not name the file.
FlatMesh ReadGmshFile(const std::string &path);

} // namespace synovia
