#pragma once

#include "synovia/general/solver_tuning.hpp"

namespace synovia
{

/// When Newton's method takes a new tangent: in each iteration but the last
/// ones, whose residual falls by the same factor as before with the tangent
/// there is (Kelley, Solving Nonlinear Equations with Newton's Method, 2003,
/// section 2.4), and by a factor of ten at least.
class TangentRenewal
{
public:
   explicit TangentRenewal(const NewtonTuning &tuning_) : tuning(tuning_) {}

   /// Whether a residual of this norm, in tolerances, takes a new tangent; to
   /// be asked once in each iteration.
   bool IsDue(mfem::real_t norm);
   /// The next residual takes a new tangent, as the equations are others.
   void Restart() { last_norm = 0.0; }

private:
   NewtonTuning tuning;
   /// 0 before the first iteration.
   mfem::real_t last_norm = 0.0;
};

} // namespace synovia
