#pragma once

#include "synovia/cases/case_problem.hpp"
#include "synovia/checks/contact_check.hpp"
#include "synovia/checks/region_measures.hpp"
#include "synovia/fem/body.hpp"

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
