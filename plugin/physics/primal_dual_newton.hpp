#pragma once

#include "synovia/physics/forcing_term.hpp"
#include "synovia/physics/stage_method.hpp"
#include "synovia/physics/tangent_renewal.hpp"

#include <string>

namespace synovia
{

/// Newton's method for nonlinear bodies, with displacements, pressures and
/// multipliers as unknowns: each iteration augments the Lagrangian. The
/// residual of the penalty term, whose nonlinearity is a hundred times the
/// bodies', is never asked to fall: the line search sees gaps as the bodies
/// resist them, and the balance is that of the multipliers alone.
///
/// With the penalties eta, an iteration solves
///
///     K du + G^T eta R du = -(r + G^T (lambda + eta g)),
///     lambda <- lambda + eta (g + R du),
///
/// the same for fluxes and pressure jumps, and then decides the active set. An
/// inexact method (ForcingTerm), quadratic in the displacement; gaps fall by
/// the ratio of penalty and resistance in each iteration beside.
class PrimalDualNewton : public StageMethod
{
public:
   using StageMethod::StageMethod;

   bool Solve(ImplicitStage &stage, ResidualTolerance &tolerance) override;

private:
   /// Evaluates the bodies and their loads.
   void EvaluateBodies(const ImplicitStage &stage);
   /// Sets the residual with tractions of @a stiffness; returns its norm.
   mfem::real_t Assess(const ImplicitStage &stage, ContactStiffness stiffness,
                       const ResidualTolerance &tolerance);
   /// Norm of the residual with multipliers alone; tightens the tolerance where
   /// that is small.
   mfem::real_t AssessBalance(ImplicitStage &stage,
                              ResidualTolerance &tolerance);
   /// Adds as much of the Newton step as the bodies can take and as doesn't
   /// make the residual grow; fails if that is next to nothing.
   bool TakeStep(ImplicitStage &stage, const ResidualTolerance &tolerance);
   /// Whether a stage that begins at rest has supports that move, beside a
   /// step's @a displacement.
   bool SupportsMove(const ImplicitStage &stage,
                     const mfem::Vector &displacement) const;
   void Add(mfem::real_t share, ImplicitStage &stage,
            const std::vector<MultiplierStep> &multipliers,
            const std::vector<TieMultipliers> &tied);
   /// Why the state can't follow one whose residual had this norm; empty if it
   /// can.
   std::string FindObstacle(const ImplicitStage &stage, mfem::real_t norm,
                            const ResidualTolerance &tolerance);
   /// Where the forces are least in balance.
   Point3 WorstPlace() const;

   /// Of the bodies and their loads, at the last state.
   mfem::BlockVector body_imbalance{spaces.Offsets()};
   /// What is missing for the balance of the fluid, with contact.
   mfem::Vector mass_imbalance;
   mfem::BlockVector residual{spaces.Offsets()};
   mfem::BlockVector step{spaces.Offsets()};
   /// Whether any step was taken in this solve.
   bool has_stepped = false;
   /// Of the line search in this solve, in tolerances.
   mfem::real_t largest_residual = 0.0;
   /// Whether the last decision changed the active set.
   bool set_changed = false;
   /// Whether the last step was taken as a whole.
   bool whole_step = true;
};

} // namespace synovia
