#pragma once

#include "synovia/checks/contact_check.hpp"
#include "synovia/checks/region_measures.hpp"
#include "synovia/fem/body.hpp"

#include <string>
#include <vector>

namespace synovia
{

/// Says in one sentence, if the sizes, loads, times and materials of a case
/// don't fit each other, what is most likely in another unit, and by which
/// factor. Collective.
std::vector<std::string>
FindUnitWarnings(const CaseFile &setup, CaseProblem &problem,
                 const std::vector<PairAtStart> &pairs,
                 const std::vector<Body> &bodies,
                 const std::vector<RegionMeasures> &regions);

} // namespace synovia
