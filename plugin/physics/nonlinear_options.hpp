#pragma once

#include "synovia/linalg/biphasic_linear_solver.hpp"

namespace synovia
{

/// Of AugmentedNewton for linear bodies and PrimalDualNewton for others.
struct NonlinearOptions
{
   /// Most iterations of Newton's method: for one set of multipliers, or in
   /// finite deformation, where each iteration has new ones, for a stage; there
   /// each search of contact that a solution gives rise to begins anew.
   int max_newton = 30;
   /// Most augmentations of a stage; finite deformation has none beside the
   /// iterations.
   int max_augmentations = 30;
   /// Relative accuracy of a linear solve that suffices to see whether the
   /// active set changes; a set that doesn't is then solved to the end. 0
   /// solves every system to the end at once. In finite deformation systems
   /// are solved as accurately as ForcingTerm says, unless this is 0.
   mfem::real_t active_set_tolerance = 1e-4;
   LinearOptions linear;
   SolverTuning tuning;
};

} // namespace synovia
