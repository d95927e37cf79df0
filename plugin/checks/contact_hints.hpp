#pragma once

#include "synovia/checks/contact_sides.hpp"
#include "synovia/checks/layer_loads.hpp"

#include <string>
#include <vector>

namespace synovia
{

/// How contact could be more accurate: with the other side as destination, or
/// with curved faces. Collective.
std::vector<std::string>
FindContactHints(const CaseFile &setup, CaseProblem &problem,
                 const std::vector<PairAtStart> &pairs,
                 const std::vector<Body> &bodies,
                 const std::vector<RegionMeasures> &regions);

} // namespace synovia
