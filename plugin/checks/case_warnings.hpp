#pragma once

#include "synovia/checks/contact_check.hpp"
#include "synovia/checks/region_measures.hpp"

#include <string>
#include <vector>

namespace synovia
{

/// Likely mistakes in a case, a sentence each, the same on all ranks: cheap
/// next to the set-up of a run, and said before its first step.
///
/// @a pairs are those that CheckContact() found, or none for a run that goes
/// on. Collective.
std::vector<std::string> FindWarnings(const CaseFile &setup,
                                      CaseProblem &problem,
                                      const std::vector<PairAtStart> &pairs);

/// The same if bodies and regions are known already.
std::vector<std::string>
FindWarnings(const CaseFile &setup, CaseProblem &problem,
             const std::vector<PairAtStart> &pairs,
             const std::vector<Body> &bodies,
             const std::vector<RegionMeasures> &regions);

} // namespace synovia
