#pragma once

#include "synovia/linalg/biphasic_linear_solver.hpp"
#include "synovia/physics/rigid_freedoms.hpp"
#include "synovia/physics/solve_record.hpp"
#include "synovia/physics/stage_equations.hpp"

#include <string>

namespace synovia
{

/// Finds Newton's direction: brings the Jacobian of a stage up to date, and
/// solves the linear system. All members are collective.
class NewtonDirection
{
public:
   /// Borrows all arguments; counts in @a record, which says why what failed.
   NewtonDirection(BiphasicSpaces &spaces, StageEquations &equations,
                   const std::vector<ContactPair *> &pairs,
                   const RigidFreedoms &freedoms, BiphasicLinearSolver &linear,
                   SolveRecord &record);

   /// Linearizes the bodies where a stage starts whose first guess is none, or
   /// impossible.
   void LinearizeStart(const ImplicitStage &stage);
   /// Brings the Jacobian to the state of @a stage, and to its last tractions;
   /// that of bodies from the start stays where it is.
   void Linearize(const ImplicitStage &stage);
   /// Keeps the derivatives of the last Linearize(), for a state in which no
   /// contact was searched since.
   void KeepTangent();
   /// Sets @a step to where the linear residual is at most @a target, in units
   /// of the @a tolerance, beginning at zero or at the last solution; false if
   /// there is no such step.
   bool Solve(const mfem::BlockVector &residual, mfem::real_t target,
              const ResidualTolerance &tolerance, mfem::BlockVector &step,
              FirstGuess guess = FirstGuess::zero);
   /// The same with the multipliers as unknowns, whose @a changes come beside
   /// those that the penalties make (MultiplierSystem).
   bool Solve(const mfem::BlockVector &residual, mfem::real_t target,
              const ResidualTolerance &tolerance, mfem::real_t compliance,
              mfem::BlockVector &step, MultiplierChanges &changes);

private:
   void LinearizeBodies(const BodyStage &stage);
   /// Counts what @a solve takes to solve for @a step, and judges the latter.
   bool Finish(const std::function<BiphasicLinearSolver::Result()> &solve,
               mfem::BlockVector &step);
   /// Fails with the bodies that are loose as contact is now.
   bool FailSolve(const std::string &reason);
   /// Whether what a force or a moment moves would leave; fails if so.
   bool Escapes(const mfem::Vector &step);

   StageEquations &equations;
   const std::vector<ContactPair *> &pairs;
   const RigidFreedoms &freedoms;
   BiphasicLinearSolver &linear;
   SolveRecord &record;
   /// Of the last system, before rigid surfaces take it up.
   mfem::Vector solution;
   /// Size of the mesh (length), where forces move surfaces or rigid bodies.
   mfem::real_t extent = 0.0;
};

} // namespace synovia
