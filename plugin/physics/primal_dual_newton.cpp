#include "synovia/physics/primal_dual_newton.hpp"
#include "synovia/fem/node_positions.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/general/text.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace synovia
{

using namespace mfem;

bool PrimalDualNewton::Solve(ImplicitStage &stage, ResidualTolerance &tolerance)
{
   const NewtonTuning &tuning = options.tuning.newton;
   ForcingTerm forcing(tuning.largest_forcing, tuning.forcing_factor,
                       tuning.curvature * options.linear.relative_tolerance);
   TangentRenewal renewal(tuning);
   SearchRule search(tuning);
   // As it did in the last solve, until something changes.
   set_rests = !set_has_changed;
   set_changed = false;
   set_has_changed = false;
   has_stepped = false;
   rejected = 0;
   damping.SetSize(spaces.Displacement().GetTrueVSize());
   damping = 0.0;
   largest_residual = 0.0;
   bool evaluated = false;
   // Since the last search of a solution.
   for (int iteration = 0; iteration < options.max_newton; iteration++)
   {
      if (!evaluated)
      {
         EvaluateBodies(stage);
      }
      const StageContact::Violations violations = contact.FindViolations(stage);
      const real_t balance = AssessBalance(stage, tolerance);
      search.AddResidual(balance);
      const bool settled = violations.within_tolerance && !set_changed;
      const bool converged = settled && balance <= 1.0;
      const bool searched =
         settled && (converged || search.IsNear(balance)) && search.Allows() &&
         contact.SearchDrifted(stage, ContactStiffness::bodies, true);
      if (converged && !searched)
      {
         contact.SetTractions(ContactStiffness::none);
         return true;
      }
      if (searched)
      {
         search.Restart();
         iteration = 0;
         renewal.Restart();
         set_changed = true;
         evaluated = false;
         continue;
      }
      if (evaluated && whole_step && contact.StiffenIfSlow(violations) &&
          contact.Update(stage, ContactStiffness::bodies))
      {
         evaluated = false;
         continue;
      }
      // The penalty term is linear in the unknowns: what the linear system
      // leaves of it need be no more than what the balance needs.
      const real_t target =
         options.active_set_tolerance > 0.0
            ? std::max(tuning.final_accuracy, forcing.Next(balance) * balance)
            : tuning.final_accuracy;
      const real_t norm = Assess(stage, ContactStiffness::penalty, tolerance);
      if (!std::isfinite(norm))
      {
         return record.report.Fail("the residual is not a finite number");
      }
      // Tractions of the penalties, above the shear modulus, would make
      // surfaces buckle.
      contact.SetTractions(ContactStiffness::bodies);
      // What sticks and what slides differ too much for the tangent of a
      // former state.
      if (renewal.IsDue(balance) || contact.HasFriction())
      {
         direction.Linearize(stage);
      }
      else
      {
         direction.KeepTangent();
      }
      const bool solved = stage.from_start && PredictsSets()
                             ? SettleFirstSet(stage, norm, target, tolerance)
                             : SolveSystem(target, tolerance);
      const StepOutcome outcome =
         solved ? TakeStep(stage, tolerance) : StepOutcome::failed;
      if (outcome == StepOutcome::failed)
      {
         return false;
      }
      if (!whole_step)
      {
         renewal.Restart();
      }
      if (outcome == StepOutcome::rejected)
      {
         // max_newton counts what is taken.
         iteration--;
         evaluated = false;
         continue;
      }
      has_stepped = true;
      set_changed =
         contact.Update(stage, ContactStiffness::bodies,
                        contact.HasFriction() ? LargestImbalance() : 0.0);
      set_rests = !set_changed;
      set_has_changed = set_has_changed || set_changed;
      evaluated = !set_changed;
      if (set_changed && search.AllowsEarly(balance))
      {
         // Points that have drifted would change a settled set once more.
         contact.SearchDrifted(stage, ContactStiffness::bodies, false);
      }
   }
   return contact.FailIterations(options.max_newton);
}

bool PrimalDualNewton::SolveSystem(real_t target,
                                   const ResidualTolerance &tolerance)
{
   const real_t compliance = options.tuning.newton.multiplier_compliance;
   // Multipliers of a set that changes are not worth the iterations.
   if (set_rests && compliance > 0.0 && !contact.Pairs().empty())
   {
      return direction.Solve(residual, target, tolerance, compliance, step,
                             changes);
   }
   changes.Clear(contact.Pairs().size());
   return direction.Solve(residual, target, tolerance, step);
}

bool PrimalDualNewton::PredictsSets() const
{
   // Slip that a linear system predicts is none.
   return options.tuning.newton.max_first_sets > 0 &&
          !contact.Pairs().empty() && !contact.HasFriction();
}

bool PrimalDualNewton::SettleFirstSet(ImplicitStage &stage, real_t norm,
                                      real_t target,
                                      const ResidualTolerance &tolerance)
{
   const real_t loose =
      std::max(target, options.tuning.newton.set_accuracy * norm);
   changes.Clear(contact.Pairs().size());
   if (!direction.Solve(residual, loose, tolerance, step))
   {
      return false;
   }
   // What a force moves alone is stopped where surfaces would overlap
   // (TakeStep()).
   bool changed = SupportsMove(stage, equations.DisplacementIn(step));
   for (int i = 0; i < options.tuning.newton.max_first_sets && changed; i++)
   {
      changed = PredictSet(stage);
      if (!changed)
      {
         Assess(stage, ContactStiffness::penalty, tolerance);
         direction.KeepTangent();
         break;
      }
      EvaluateBodies(stage);
      Assess(stage, ContactStiffness::penalty, tolerance);
      contact.SetTractions(ContactStiffness::none);
      direction.Linearize(stage);
      if (!direction.Solve(residual, loose, tolerance, step, FirstGuess::given))
      {
         return false;
      }
   }
   return direction.Solve(residual, target, tolerance, step, FirstGuess::given);
}

bool PrimalDualNewton::PredictSet(ImplicitStage &stage)
{
   const Vector u(stage.u);
   const Vector p(stage.p);
   const RigidPoses poses(stage.poses);
   const MultiplierSteps multipliers =
      FindMultiplierSteps(equations.DisplacementIn(step));
   Add(1.0, stage, multipliers);
   equations.EvaluateContact(stage);
   const bool changed = contact.Update(stage, ContactStiffness::bodies);
   Add(-1.0, stage, multipliers);
   stage.u = u;
   stage.p = p;
   stage.poses = poses;
   equations.UpdateDrainedDofs(stage);
   return changed;
}

void PrimalDualNewton::EvaluateBodies(const ImplicitStage &stage)
{
   equations.ComputeBodyImbalance(stage, body_imbalance.GetBlock(0),
                                  body_imbalance.GetBlock(1));
}

void PrimalDualNewton::SetResidual(const ImplicitStage &stage,
                                   ContactStiffness stiffness, real_t share)
{
   contact.SetTractions(stiffness);
   residual = body_imbalance;
   residual.GetBlock(0).Add(share, damping);
   equations.AddContactImbalance(stage, residual.GetBlock(0),
                                 residual.GetBlock(1));
   mass_imbalance = residual.GetBlock(1);
   equations.MakeResidual(stage, residual);
}

real_t PrimalDualNewton::Assess(const ImplicitStage &stage,
                                ContactStiffness stiffness,
                                const ResidualTolerance &tolerance)
{
   SetResidual(stage, stiffness, 0.0);
   return linear.Norm(residual, tolerance);
}

real_t PrimalDualNewton::AssessTrial(const ImplicitStage &stage, real_t share,
                                     const ResidualTolerance &tolerance)
{
   SetResidual(stage, ContactStiffness::bodies, share);
   return linear.Norm(residual, tolerance.Untightened());
}

real_t PrimalDualNewton::AssessBalance(ImplicitStage &stage,
                                       ResidualTolerance &tolerance)
{
   // Where the balance is this good, and the set rests, so is what is known of
   // the fluid, but not before anything has moved: what a rigid partner presses
   // is in balance until then.
   constexpr real_t known = 1e4;
   real_t norm = Assess(stage, ContactStiffness::none, tolerance);
   if (norm <= 1.0 && stage.from_start)
   {
      stage.from_start = false;
      EvaluateBodies(stage);
      norm = Assess(stage, ContactStiffness::none, tolerance);
   }
   const bool rests = !set_changed && !stage.from_start;
   if (rests &&
       ((has_stepped && norm <= known) ||
        rule.KnowsExchange(mass_imbalance, residual.GetBlock(1))) &&
       rule.Tighten(mass_imbalance, tolerance))
   {
      norm = linear.Norm(residual, tolerance);
   }
   return norm;
}

PrimalDualNewton::StepOutcome
PrimalDualNewton::TakeStep(ImplicitStage &stage,
                           const ResidualTolerance &tolerance)
{
   const real_t least_share = options.tuning.newton.shortest_step;
   const Vector displacement = equations.DisplacementIn(step);
   const MultiplierSteps multipliers = FindMultiplierSteps(displacement);
   // From the stage's start the step and the supports' increments go together,
   // and what there was is no measure for what there will be; nor is it where
   // tractions of friction are released or caught.
   const bool from_start = stage.from_start;
   const real_t limit = from_start || contact.SlidingChanged()
                           ? std::numeric_limits<real_t>::infinity()
                           : AssessTrial(stage, 0.0, tolerance);
   if (std::isfinite(limit))
   {
      largest_residual = std::max(largest_residual, limit);
   }
   damping = 0.0;
   equations.Bodies().AddDampingForces(displacement, damping);
   stage.from_start = false;
   const bool may_be_short = !from_start || !SupportsMove(stage, displacement);
   const real_t most =
      may_be_short ? contact.ShareBeforeOverlap(displacement) : 1.0;
   contact.Remember();
   Add(most, stage, multipliers);
   std::string obstacle = FindObstacle(stage, most, limit, tolerance);
   const bool reaches = obstacle.empty();
   whole_step = reaches && most == 1.0;
   if (!reaches && !from_start)
   {
      Add(-most, stage, multipliers);
      contact.GoBack();
      if (Rejects(stage, displacement))
      {
         return StepOutcome::rejected;
      }
      Add(most, stage, multipliers);
   }
   rejected = 0;
   for (real_t share = 0.5 * most;
        !obstacle.empty() && may_be_short && share >= least_share * most;
        share *= 0.5)
   {
      Add(-share, stage, multipliers);
      contact.GoBack();
      obstacle = FindObstacle(stage, share, limit, tolerance);
   }
   if (!obstacle.empty())
   {
      record.report.Fail(obstacle);
      return StepOutcome::failed;
   }
   if (reaches)
   {
      equations.Bodies().EaseDamping();
   }
   return StepOutcome::taken;
}

bool PrimalDualNewton::Rejects(const ImplicitStage &stage,
                               const Vector &displacement)
{
   // A direction that strains elements too much is likely to be a wrong one: a
   // part of it leads to where the next one is no better.
   constexpr int most_rejected = 5;
   if (rejected == most_rejected ||
       !equations.Bodies().Damp(stage, displacement))
   {
      return false;
   }
   equations.EvaluateContact(stage);
   rejected++;
   return true;
}

PrimalDualNewton::MultiplierSteps
PrimalDualNewton::FindMultiplierSteps(const Vector &displacement) const
{
   MultiplierSteps steps;
   for (const ContactPair *pair : contact.Pairs())
   {
      const std::size_t term = steps.pairs.size();
      steps.pairs.push_back(pair->FindMultiplierStep(
         displacement, step.GetBlock(1), changes.forces[term],
         changes.outflows[term]));
   }
   for (const TiedInterface *tie : contact.Interfaces())
   {
      steps.interfaces.push_back(
         tie->FindMultiplierStep(displacement, step.GetBlock(1)));
   }
   return steps;
}

bool PrimalDualNewton::SupportsMove(const ImplicitStage &stage,
                                    const Vector &displacement) const
{
   constexpr real_t round_off = 1e-9;
   Vector moved(stage.u);
   moved -= stage.u0;
   const auto largest = [this](const Vector &x) {
      return MaxOverRanks(x.Size() > 0 ? x.Normlinf() : 0.0, spaces.GetComm());
   };
   return largest(moved) > round_off * largest(displacement);
}

void PrimalDualNewton::Add(real_t share, ImplicitStage &stage,
                           const MultiplierSteps &multipliers)
{
   equations.Add(share, step, stage);
   for (std::size_t i = 0; i < multipliers.pairs.size(); i++)
   {
      contact.Pairs()[i]->Enforcement().AddToMultipliers(share,
                                                         multipliers.pairs[i]);
   }
   for (std::size_t i = 0; i < multipliers.interfaces.size(); i++)
   {
      contact.Interfaces()[i]->AddToMultipliers(share,
                                                multipliers.interfaces[i]);
   }
}

std::string PrimalDualNewton::FindObstacle(const ImplicitStage &stage,
                                           real_t share, real_t norm,
                                           const ResidualTolerance &tolerance)
{
   // Newton's method may have to climb a little before it falls; what is next
   // to the tolerance is round-off.
   const NewtonTuning &tuning = options.tuning.newton;
   const std::string impossible = equations.Bodies().Validate(stage);
   if (!impossible.empty())
   {
      return impossible;
   }
   equations.EvaluateContact(stage);
   EvaluateBodies(stage);
   const real_t now = AssessTrial(stage, share, tolerance);
   // What slides goes farther than the bodies' own increments.
   const real_t growth = tuning.residual_growth *
                         (contact.HasFriction() ? tuning.sliding_growth : 1.0);
   if (now <= std::max({tuning.residual_floor, growth * norm,
                        tuning.small_residual * largest_residual}))
   {
      return "";
   }
   const Point3 place = WorstPlace();
   return "along Newton's direction the residual grows from " + ToText(norm) +
          " to " + ToText(now) + " times its tolerance, most of all at (" +
          ToText(place[0]) + ", " + ToText(place[1]) + ", " + ToText(place[2]) +
          ")";
}

real_t PrimalDualNewton::LargestImbalance() const
{
   const Vector &forces = residual.GetBlock(0);
   return MaxOverRanks(forces.Size() > 0 ? forces.Normlinf() : 0.0,
                       spaces.GetComm());
}

Point3 PrimalDualNewton::WorstPlace() const
{
   const Vector &forces = residual.GetBlock(0);
   real_t largest_force = -1.0;
   int largest = 0;
   for (int i = 0; i < forces.Size(); i++)
   {
      if (std::abs(forces[i]) > largest_force)
      {
         largest_force = std::abs(forces[i]);
         largest = i;
      }
   }
   MPI_Comm comm = spaces.GetComm();
   const RankedValue worst = LargestOverRanks(largest_force, comm);
   const Vector positions = NodePositions(spaces.Displacement());
   Point3 place{{0.0, 0.0, 0.0}};
   for (int d = 0; d < 3 && worst.here; d++)
   {
      // The three components of a node follow each other.
      place[d] = positions[largest / 3 * 3 + d];
   }
   MPI_Bcast(place.data(), 3, MPITypeMap<real_t>::mpi_type, worst.rank, comm);
   return place;
}

} // namespace synovia
