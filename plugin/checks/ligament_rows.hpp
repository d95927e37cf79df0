#pragma once

#include "synovia/fem/boundary_conditions.hpp"

#include <string>
#include <vector>

namespace synovia
{

/// The ligaments of a problem as rows of a table, the first with titles: name,
/// what it joins, and its length, force and stiffness as meshed; empty if there
/// are none.
std::vector<std::vector<std::string>>
LigamentRows(const BoundaryConditions &conditions);

} // namespace synovia
