#pragma once

#include "synovia/checks/contact_sides.hpp"
#include "synovia/checks/layer_loads.hpp"

#include <string>
#include <vector>

namespace synovia
{

/// What would make contact more accurate, for people who ask: the other side as
/// destination, or curved faces. Collective.
std::vector<std::string>
FindContactHints(const CaseFile &setup, CaseProblem &problem,
                 const std::vector<PairAtStart> &pairs,
                 const std::vector<Body> &bodies,
                 const std::vector<RegionMeasures> &regions);

} // namespace synovia
