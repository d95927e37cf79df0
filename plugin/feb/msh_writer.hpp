#pragma once

#include "synovia/feb/feb_surfaces.hpp"

#include <set>
#include <string>

namespace synovia
{

/// The parts whose places are given and the surfaces, as an MSH file of version
/// 2.2. Parts and surfaces are physical groups, nodes and volume elements keep
/// their numbers, coordinates all digits.
std::string MshText(const FebMesh &mesh, const std::set<int> &parts,
                    const FebSurfaces &surfaces);

} // namespace synovia
