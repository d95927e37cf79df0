#pragma once

#include "synovia/fem/boundary_conditions.hpp"

#include <string>
#include <vector>

namespace synovia
{

/// The joints of a problem as rows of a table, the first with titles: name,
/// side, its two bodies, and which coordinates are prescribed; empty if there
/// are none.
std::vector<std::vector<std::string>>
JointRows(const BoundaryConditions &conditions);

} // namespace synovia
