#pragma once

#include "checks/region_measures.hpp"

#include <string>
#include <vector>

namespace synovia
{

/// Loads that are much slower or faster than the fluid, loads and lines that
/// the run doesn't reach.
std::vector<std::string>
FindTimeWarnings(const CaseFile &setup,
                 const std::vector<RegionMeasures> &regions);

} // namespace synovia
