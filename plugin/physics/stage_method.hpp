#pragma once

#include "synovia/linalg/biphasic_linear_solver.hpp"
#include "synovia/physics/stage_equations.hpp"

namespace synovia
{

/// A method that solves the equations of a stage together with the conditions
/// of its contact.
class StageMethod
{
public:
   virtual ~StageMethod() = default;

   /// Brings @a stage from its first guess, where contact is evaluated, to
   /// where the residual is within @a tolerance, which may become smaller, and
   /// gaps and pressure jumps within theirs. If it fails, the record says why.
   /// Collective.
   virtual bool Solve(ImplicitStage &stage, ResidualTolerance &tolerance) = 0;
};

} // namespace synovia
