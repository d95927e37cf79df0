#pragma once

#include "synovia/cases/case_file.hpp"

#include <string>
#include <vector>

namespace synovia
{

/// Loads and lines that the run doesn't reach.
std::vector<std::string> FindTimeWarnings(const CaseFile &setup);

} // namespace synovia
