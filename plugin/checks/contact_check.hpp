#pragma once

#include "synovia/cases/case_problem.hpp"

#include <string>
#include <vector>

namespace synovia
{

/// A contact pair as the run finds it at the start (length).
struct PairAtStart
{
   std::string name;
   /// The least weighted gap where the surfaces see each other; negative where
   /// they overlap.
   mfem::real_t least_gap = 0.0;
   mfem::real_t gap_tolerance = 0.0;
   mfem::real_t search_radius = 0.0;
   /// Coefficient and solid fraction, in words; empty without.
   std::string friction;
};

/// Makes all contact pairs and lets each search once where the run starts, see
/// FirstApproach. Collective.
/// Throws Error that lists those that can't be, with their places.
std::vector<PairAtStart> CheckContact(const CaseFile &setup,
                                      CaseProblem &problem);

} // namespace synovia
