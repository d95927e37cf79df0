#pragma once

#include "synovia/checks/contact_check.hpp"
#include "synovia/checks/region_measures.hpp"

#include <string>
#include <vector>

namespace synovia
{

/// Bodies that are free to move or to turn, as neither supports nor springs
/// resist it, and contact can't: a sentence for each, with the directions, why
/// contact can't, and what to do.
///
/// Contact holds no motion along which its surfaces slide, none away from what
/// it touches unless a load presses against that, and none before it touches.
/// Collective.
std::vector<std::string>
FindLooseBodies(const CaseFile &setup, CaseProblem &problem,
                const std::vector<PairAtStart> &pairs,
                const std::vector<Body> &bodies,
                const std::vector<RegionMeasures> &regions);

} // namespace synovia
