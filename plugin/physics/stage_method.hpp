#pragma once

#include "synovia/physics/newton_direction.hpp"
#include "synovia/physics/nonlinear_options.hpp"
#include "synovia/physics/stage_contact.hpp"
#include "synovia/physics/tolerance_rule.hpp"

namespace synovia
{

/// A method that solves the equations of a stage together with the conditions
/// of its contact.
class StageMethod
{
public:
   /// Borrows all arguments.
   StageMethod(BiphasicSpaces &spaces, StageEquations &equations,
               StageContact &contact, const ToleranceRule &rule,
               NewtonDirection &direction, const BiphasicLinearSolver &linear,
               const NonlinearOptions &options, SolveRecord &record);
   virtual ~StageMethod() = default;

   /// Brings @a stage from its first guess, where contact is evaluated, to
   /// where the residual is within @a tolerance, which may become smaller, and
   /// gaps and pressure jumps within theirs. If it fails, the record says why.
   /// Collective.
   virtual bool Solve(ImplicitStage &stage, ResidualTolerance &tolerance) = 0;

protected:
   BiphasicSpaces &spaces;
   StageEquations &equations;
   StageContact &contact;
   const ToleranceRule &rule;
   NewtonDirection &direction;
   const BiphasicLinearSolver &linear;
   const NonlinearOptions &options;
   SolveRecord &record;
};

} // namespace synovia
