#pragma once

#include "synovia/mesh/named_mesh.hpp"

#include <string>
#include <vector>

namespace synovia
{

/// A case file of miniapps/cases with a mesh of boxes that has its names.
struct ShippedCase
{
   std::string name;
   std::string text;
   NamedMesh mesh;
};

/// All of them. Collective.
std::vector<ShippedCase> ShippedCases();

} // namespace synovia
