#pragma once

#include "synovia/general/solver_tuning.hpp"

namespace synovia
{

/// When Newton's method searches contact anew within a solve: while the active
/// set changes, in the first iterations, and once it has settled with the
/// partners there are, NewtonTuning::max_searches times at most. No more where
/// searches undo each other, as for points near an edge, which go back and
/// forth: where the residual falls no more while the set changes, or a search
/// of a settled one upset the balance nearly as much as the one before it.
class SearchRule
{
public:
   explicit SearchRule(const NewtonTuning &tuning_) : tuning(tuning_) {}

   /// Takes the norm of an iteration's residual, in tolerances.
   void AddResidual(mfem::real_t norm);
   /// Whether a set that an iteration with this residual has changed may be
   /// searched for at once; to be asked once for each change.
   bool AllowsEarly(mfem::real_t norm);
   /// Whether this residual is so small a part of what there was since the last
   /// search that another one would upset it by more.
   bool IsNear(mfem::real_t norm) const;
   /// Whether a new search of a settled set would lead anywhere.
   bool Allows() const;
   /// Contact was searched anew.
   void Restart();

private:
   NewtonTuning tuning;
   int early_searches = 0;
   int searches = 0;
   /// Largest residuals after the last search and after the one before it, or
   /// after the start of the solve.
   mfem::real_t last = 0.0;
   mfem::real_t before_last = 0.0;
   /// Smallest residual of the iterations that changed the set.
   mfem::real_t least = mfem::infinity();
};

} // namespace synovia
