#pragma once

#include "synovia/physics/biphasic_newton_solver.hpp"
#include "synovia/physics/first_approach.hpp"

#include <vector>

namespace synovia
{

/// Solves implicit stages: Newton's method for given multipliers, new searches
/// where points have slid to other partners, and augmentations until gaps and
/// pressure jumps are within tolerance.
class StageSolver
{
public:
   /// Borrows all arguments. Collective.
   StageSolver(const std::vector<Body> &bodies, BiphasicSpaces &spaces,
               BoundaryConditions &conditions,
               const std::vector<ContactPair *> &pairs,
               const FirstApproach &start, StageEquations &equations,
               const NonlinearOptions &options, SolveRecord &record);

   /// Brings @a stage, which is the first guess and has its loads, to where its
   /// equations and contact hold; @a touch says what touches at first. If it
   /// fails, the record says why. Collective.
   bool Solve(ImplicitStage &stage, TouchRule touch);

   const BiphasicLinearSolver &LinearSolver() const { return linear; }

private:
   /// For multipliers as they are, with partners where they belong.
   bool SolveSliding(ImplicitStage &stage, ResidualTolerance &tolerance,
                     StageContact::Violations &violations);
   /// Corrects the multipliers, and penalties that are too soft.
   void Augment(ImplicitStage &stage, ResidualTolerance &tolerance,
                const StageContact::Violations &violations);
   bool FailAugmentations(const StageContact::Violations &violations);

   const std::vector<ContactPair *> &pairs;
   StageEquations &equations;
   const NonlinearOptions &options;
   SolveRecord &record;
   RigidFreedoms freedoms;
   BiphasicLinearSolver linear;
   ToleranceRule rule;
   StageContact contact;
   BiphasicNewtonSolver newton;
};

} // namespace synovia
