#pragma once

#include "cases/case_problem.hpp"
#include "cases/contact_check.hpp"
#include "checks/region_measures.hpp"
#include "physics/body.hpp"

#include <string>
#include <vector>

namespace synovia
{

/// Bodies that fluid can't leave, and those that contact alone holds where it
/// can't: from one side with no load against it, not at all, or not yet.
/// Collective.
std::vector<std::string>
FindBodyWarnings(const CaseFile &setup, CaseProblem &problem,
                 const std::vector<PairAtStart> &pairs,
                 const std::vector<Body> &bodies,
                 const std::vector<RegionMeasures> &regions);

} // namespace synovia
