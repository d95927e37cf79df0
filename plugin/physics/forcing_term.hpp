#pragma once

#include "mfem.hpp"

namespace synovia
{

/// How accurately an inexact Newton method solves its linear systems: as the
/// residual falls from one iteration to the next (Eisenstat & Walker, SIAM J
/// Sci Comput 17:16-32, 1996, choice 2), so that no system is solved more
/// accurately than the next one needs it.
class ForcingTerm
{
public:
   /// @a largest: of all terms. @a curvature: what the first iteration is
   /// expected to leave of a unit residual, which grows with its square.
   ForcingTerm(mfem::real_t largest_, mfem::real_t factor_,
               mfem::real_t curvature_)
      : largest(largest_), factor(factor_), curvature(curvature_)
   {
   }

   /// Tolerance of the linear residual relative to @a norm, the norm of the
   /// nonlinear residual in the linearized state.
   mfem::real_t Next(mfem::real_t norm);

private:
   mfem::real_t largest;
   mfem::real_t factor;
   mfem::real_t curvature;
   /// 0 before the first iteration.
   mfem::real_t last_norm = 0.0;
};

} // namespace synovia
