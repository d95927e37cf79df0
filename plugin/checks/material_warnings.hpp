#pragma once

#include "synovia/cases/case_file.hpp"

#include <string>
#include <vector>

namespace synovia
{

/// Drained solids that are nearly incompressible.
std::vector<std::string> FindMaterialWarnings(const CaseFile &setup);

} // namespace synovia
