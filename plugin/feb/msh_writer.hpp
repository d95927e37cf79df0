#pragma once

#include "synovia/feb/feb_element_data.hpp"
#include "synovia/feb/feb_surfaces.hpp"

#include <set>
#include <string>

namespace synovia
{

/// The parts whose places are given and the surfaces, as an MSH file of version
/// 2.2. Parts and surfaces are physical groups, nodes and volume elements keep
/// their numbers, coordinates all digits; @a fields are $ElementData.
std::string
MshText(const FebMesh &mesh, const std::set<int> &parts,
        const FebSurfaces &surfaces,
        const std::map<std::string, FebElementData::Vectors> &fields);

} // namespace synovia
