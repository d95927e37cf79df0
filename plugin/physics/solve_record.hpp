#pragma once

#include "synovia/linalg/work_counts.hpp"

#include "mfem.hpp"

#include <string>

namespace synovia
{

/// What it took to solve the stages of a step.
struct SolveReport
{
   bool converged = true;
   /// Why not, if not.
   std::string reason;
   int newton = 0;
   int augmentations = 0;
   int linear = 0;
   /// The most that one linear system took.
   int most_linear = 0;
   /// How far the linear systems' residuals fell, as decimal logarithms, all
   /// together.
   mfem::real_t decades = 0.0;
   int searches = 0;

   /// Takes the reason why a stage could not be solved; returns false.
   bool Fail(const std::string &why)
   {
      converged = false;
      reason = why;
      return false;
   }
};

/// Where the time goes, in seconds of this rank since the start.
struct PhaseTimes
{
   mfem::real_t assembly = 0.0;
   mfem::real_t search = 0.0;
   /// Hierarchies, factorizations and updates of preconditioners.
   mfem::real_t setup = 0.0;
   /// Linear systems without that.
   mfem::real_t linear = 0.0;

   PhaseTimes &operator+=(const PhaseTimes &other)
   {
      assembly += other.assembly;
      search += other.search;
      setup += other.setup;
      linear += other.linear;
      return *this;
   }
};

/// What the parts of a solver count together.
struct SolveRecord
{
   /// Of the step in progress.
   SolveReport report;
   PhaseTimes times;
   /// Since the start, without that of the linear solver.
   WorkCounts work;
};

} // namespace synovia
