#pragma once

#include "synovia/physics/first_approach.hpp"
#include "synovia/physics/newton_direction.hpp"
#include "synovia/physics/nonlinear_options.hpp"
#include "synovia/physics/stage_contact.hpp"
#include "synovia/physics/stage_method.hpp"
#include "synovia/physics/tolerance_rule.hpp"

#include <memory>
#include <vector>

namespace synovia
{

/// Solves implicit stages, by AugmentedNewton where the bodies are linear, else
/// by PrimalDualNewton.
class StageSolver
{
public:
   /// Borrows all arguments. Collective.
   StageSolver(const std::vector<Body> &bodies, BiphasicSpaces &spaces,
               BoundaryConditions &conditions,
               const std::vector<ContactPair *> &pairs,
               const std::vector<TiedInterface *> &interfaces,
               const FirstApproach &start, StageEquations &equations,
               const NonlinearOptions &options, SolveRecord &record);

   /// Brings @a stage, which is the first guess and has its loads, to where its
   /// equations and contact hold; @a touch says what touches at first. If it
   /// fails, the record says why. Collective.
   bool Solve(ImplicitStage &stage, TouchRule touch);

   const BiphasicLinearSolver &LinearSolver() const { return linear; }

private:
   const std::vector<ContactPair *> &pairs;
   const std::vector<TiedInterface *> &interfaces;
   StageEquations &equations;
   SolveRecord &record;
   RigidFreedoms freedoms;
   BiphasicLinearSolver linear;
   ToleranceRule rule;
   StageContact contact;
   NewtonDirection direction;
   std::unique_ptr<StageMethod> method;
};

} // namespace synovia
