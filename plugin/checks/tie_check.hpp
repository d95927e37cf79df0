#pragma once

#include "synovia/cases/case_problem.hpp"

#include <string>
#include <vector>

namespace synovia
{

/// A tie as the run finds it.
struct TieAtStart
{
   std::string name;
   /// Part of the destination's area that the source covers.
   mfem::real_t covered = 0.0;
   /// Largest distance between the undeformed surfaces, and how far they look
   /// for each other (length).
   mfem::real_t distance = 0.0;
   mfem::real_t search_radius = 0.0;
   /// Whether fluid passes.
   bool exchanges = false;
};

/// Makes all ties and lets them search. Collective. Throws Error that lists
/// those that can't be, with their places.
std::vector<TieAtStart> CheckTies(const CaseFile &setup, CaseProblem &problem);

/// The rows of a table, under a row of headings; empty without ties.
std::vector<std::vector<std::string>>
TieRows(const std::vector<TieAtStart> &ties);

/// What may not be meant, a sentence each.
std::vector<std::string> FindTieHints(const CaseFile &setup,
                                      const std::vector<TieAtStart> &ties);

} // namespace synovia
