#pragma once

#include "synovia/fem/boundary_conditions.hpp"

#include <string>
#include <vector>

namespace synovia
{

/// The rigid bodies of a problem as rows of a table, the first with titles:
/// name, reference point, and what moves each translation and rotation; empty
/// if there are none. Collective.
std::vector<std::vector<std::string>>
RigidBodyRows(const BoundaryConditions &conditions, BiphasicSpaces &spaces);

} // namespace synovia
