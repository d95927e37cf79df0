#pragma once

#include "synovia/physics/stage_method.hpp"

namespace synovia
{

/// The augmented Lagrangian method for bodies whose equations are linear (Guo &
/// Spilker 2014): Newton's method on the active set for multipliers as they
/// are, and augmentations that correct these.
class AugmentedNewton : public StageMethod
{
public:
   using StageMethod::StageMethod;

   bool Solve(ImplicitStage &stage, ResidualTolerance &tolerance) override;

private:
   /// For multipliers as they are.
   bool SolveContact(ImplicitStage &stage, ResidualTolerance &tolerance);
   /// Corrects the multipliers, and penalties that are too soft.
   void Augment(ImplicitStage &stage, ResidualTolerance &tolerance,
                const StageContact::Violations &violations);
   bool FailAugmentations(const StageContact::Violations &violations);
   /// Norm of the linear residual for one of the stage of this norm.
   mfem::real_t LinearTarget(mfem::real_t norm) const;
};

} // namespace synovia
