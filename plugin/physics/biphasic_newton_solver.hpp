#pragma once

#include "synovia/physics/forcing_term.hpp"
#include "synovia/physics/nonlinear_options.hpp"
#include "synovia/physics/rigid_freedoms.hpp"
#include "synovia/physics/stage_contact.hpp"
#include "synovia/physics/tolerance_rule.hpp"

#include <string>

namespace synovia
{

/// Newton's method for a stage whose multipliers are given: residual and
/// Jacobian, a linear solve, a line search, and then the active set anew.
///
/// An inexact method where the equations are nonlinear (ForcingTerm). All
/// members are collective.
class BiphasicNewtonSolver
{
public:
   /// Borrows all arguments.
   BiphasicNewtonSolver(BiphasicSpaces &spaces, StageEquations &equations,
                        StageContact &contact, const RigidFreedoms &freedoms,
                        const ToleranceRule &rule, BiphasicLinearSolver &linear,
                        const NonlinearOptions &options, SolveRecord &record);

   /// Linearizes the bodies where a stage starts whose first guess is none, or
   /// impossible.
   void LinearizeStart(const ImplicitStage &stage);

   /// Brings @a stage to where the residual is within @a tolerance, which it
   /// tightens. Of nonlinear bodies it ends early where the active set has
   /// settled and multipliers are yet to be corrected: these change what the
   /// iterations converge to. Takes what gaps are left in @a violations. If it
   /// fails, the record says why.
   bool Solve(ImplicitStage &stage, ResidualTolerance &tolerance,
              StageContact::Violations &violations);

private:
   void LinearizeBodies(const BodyStage &stage);
   /// Brings the contact's derivatives to its last update.
   void LinearizeContact(const ImplicitStage &stage);
   /// Solves for Newton's direction at a residual of this norm.
   bool SolveLinear(const mfem::BlockVector &residual, mfem::real_t norm,
                    const ResidualTolerance &tolerance, ForcingTerm &forcing,
                    mfem::BlockVector &step);
   /// Norm of the linear residual for a nonlinear one of this norm.
   mfem::real_t LinearTarget(mfem::real_t norm, ForcingTerm &forcing) const;
   /// Adds the Newton step and evaluates the contact there. Of nonlinear bodies
   /// it adds as much as they can take and as doesn't make the residual, of
   /// which @a norm was the norm, grow; fails if that is next to nothing. With
   /// the active set as it is, @a residual is that of the new state then.
   bool TakeStep(const mfem::BlockVector &step, mfem::real_t norm,
                 const ResidualTolerance &tolerance, ImplicitStage &stage,
                 mfem::BlockVector &residual);
   /// Why the state can't follow one whose residual had this norm; empty if it
   /// can. Else @a residual is that of the state.
   std::string FindObstacle(const ImplicitStage &stage, mfem::real_t norm,
                            const ResidualTolerance &tolerance,
                            mfem::BlockVector &residual);
   /// Where the forces are least in balance.
   Point3 WorstPlace(const mfem::BlockVector &residual) const;
   /// Fails with the bodies that are loose as contact is now.
   bool FailSolve(const std::string &reason);
   /// Whether a surface that a force moves would leave; fails if so.
   bool Escapes(const mfem::Vector &step);

   BiphasicSpaces &spaces;
   StageEquations &equations;
   StageContact &contact;
   const RigidFreedoms &freedoms;
   const ToleranceRule &rule;
   BiphasicLinearSolver &linear;
   const NonlinearOptions &options;
   SolveRecord &record;
   /// Size of the mesh (length), where surfaces are driven.
   mfem::real_t extent = 0.0;
};

} // namespace synovia
