#pragma once

#include "synovia/physics/forcing_term.hpp"
#include "synovia/physics/search_rule.hpp"
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
   /// Of the pairs and of the tied interfaces, in order.
   struct MultiplierSteps
   {
      std::vector<MultiplierStep> pairs;
      std::vector<TieMultipliers> interfaces;
   };

   /// Solves for step and changes with the present residual.
   bool SolveSystem(mfem::real_t target, const ResidualTolerance &tolerance);
   /// Whether active sets are predicted from the start of a stage.
   bool PredictsSets() const;
   /// From the start of a stage, where the residual has this @a norm, solves
   /// again with the active set that the step leads to, until it rests: few
   /// vertices would bear all of a first contact else, and the bodies would be
   /// too distorted around them to go on from. Roughly, and to @a target in the
   /// end.
   bool SettleFirstSet(ImplicitStage &stage, mfem::real_t norm,
                       mfem::real_t target, const ResidualTolerance &tolerance);
   /// Decides on the active set where the step would lead; says whether it is
   /// another.
   bool PredictSet(ImplicitStage &stage);
   /// Evaluates the bodies and their loads.
   void EvaluateBodies(const ImplicitStage &stage);
   /// Sets the residual with tractions of @a stiffness, and with a @a share of
   /// what damping resists the step with.
   void SetResidual(const ImplicitStage &stage, ContactStiffness stiffness,
                    mfem::real_t share);
   /// Sets the residual with tractions of @a stiffness, and nothing of damping;
   /// returns its norm.
   mfem::real_t Assess(const ImplicitStage &stage, ContactStiffness stiffness,
                       const ResidualTolerance &tolerance);
   /// The same for the line search, after a @a share of the step: with the
   /// share of what damping resists it with, as the linear system has it, and
   /// of the tolerance before it was tightened.
   mfem::real_t AssessTrial(const ImplicitStage &stage, mfem::real_t share,
                            const ResidualTolerance &tolerance);
   /// Norm of the residual with multipliers alone; tightens the tolerance where
   /// that is small.
   mfem::real_t AssessBalance(ImplicitStage &stage,
                              ResidualTolerance &tolerance);
   enum class StepOutcome
   {
      taken,
      /// Not taken; another one will be found in the same state, with damping.
      rejected,
      failed
   };
   /// Adds as much of the Newton step as the bodies can take and as doesn't
   /// make the residual grow. Where that is not all of it, rejects the step if
   /// the bodies' tangents can be damped, a few times; fails if it is next to
   /// nothing.
   StepOutcome TakeStep(ImplicitStage &stage,
                        const ResidualTolerance &tolerance);
   /// Whether a step that can't be taken whole is rejected, with its
   /// @a displacement from @a stage: damps what makes it too large.
   bool Rejects(const ImplicitStage &stage, const mfem::Vector &displacement);
   /// Whether a stage that begins at rest has supports that move, beside a
   /// step's @a displacement.
   bool SupportsMove(const ImplicitStage &stage,
                     const mfem::Vector &displacement) const;
   /// In the step, which has this @a displacement.
   MultiplierSteps FindMultiplierSteps(const mfem::Vector &displacement) const;
   /// Adds a part of the step, and of the multipliers'.
   void Add(mfem::real_t share, ImplicitStage &stage,
            const MultiplierSteps &multipliers);
   /// Why the state after a @a share of the step can't follow one whose
   /// residual had this norm; empty if it can.
   std::string FindObstacle(const ImplicitStage &stage, mfem::real_t share,
                            mfem::real_t norm,
                            const ResidualTolerance &tolerance);
   /// By how much any component of a nodal force is out of balance in the last
   /// residual.
   mfem::real_t LargestImbalance() const;
   /// Where the forces are least in balance.
   Point3 WorstPlace() const;

   /// Of the bodies and their loads, at the last state.
   mfem::BlockVector body_imbalance{spaces.Offsets()};
   /// What is missing for the balance of the fluid, with contact.
   mfem::Vector mass_imbalance;
   mfem::BlockVector residual{spaces.Offsets()};
   mfem::BlockVector step{spaces.Offsets()};
   /// What damping resists the step with.
   mfem::Vector damping;
   /// Of the multipliers in the step, beside what the penalties make.
   MultiplierChanges changes;
   /// Whether any step was taken in this solve.
   bool has_stepped = false;
   /// Steps one after the other.
   int rejected = 0;
   /// Of the line search in this solve, in tolerances.
   mfem::real_t largest_residual = 0.0;
   /// Whether the last decision changed the active set.
   bool set_changed = false;
   /// Whether any did in this solve.
   bool set_has_changed = true;
   /// Whether the next one is likely to keep it.
   bool set_rests = false;
   /// Whether the last step was taken as a whole.
   bool whole_step = true;
};

} // namespace synovia
