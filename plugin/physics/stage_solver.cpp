#include "synovia/physics/stage_solver.hpp"
#include "synovia/general/phase_timer.hpp"
#include "synovia/general/text.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
BiphasicLinearSolver MakeLinearSolver(const StageEquations &equations,
                                      BiphasicSpaces &spaces,
                                      const NonlinearOptions &options,
                                      PhaseTimes &times)
{
   const PhaseTimer timer(times.setup);
   return BiphasicLinearSolver(equations.Jacobian(), spaces, options.linear,
                               options.tuning);
}
} // namespace

StageSolver::StageSolver(const std::vector<Body> &bodies,
                         BiphasicSpaces &spaces, BoundaryConditions &conditions,
                         const std::vector<ContactPair *> &pairs_,
                         const FirstApproach &start, StageEquations &equations_,
                         const NonlinearOptions &options_, SolveRecord &record_)
   : pairs(pairs_), equations(equations_), options(options_), record(record_),
     freedoms(bodies, spaces, conditions),
     linear(MakeLinearSolver(equations, spaces, options, record.times)),
     rule(spaces, conditions, pairs, equations,
          options.linear.relative_tolerance),
     contact(spaces.GetComm(), pairs, start.pushed, equations, linear, record),
     newton(spaces, equations, contact, freedoms, rule, linear, options, record)
{
}

bool StageSolver::Solve(ImplicitStage &stage, TouchRule touch)
{
   newton.LinearizeStart(stage);
   equations.SetTimeStep(stage.dt);
   contact.Start(stage, touch);
   ResidualTolerance tolerance = rule.Find(stage, linear.ForcePerVolume());
   for (int augmentation = 0;; augmentation++)
   {
      StageContact::Violations violations;
      if (!SolveSliding(stage, tolerance, violations))
      {
         return false;
      }
      if (violations.within_tolerance)
      {
         break;
      }
      if (augmentation == options.max_augmentations)
      {
         return FailAugmentations(violations);
      }
      Augment(stage, tolerance, violations);
   }
   // Residuals may be forces of contact that bears nothing.
   constexpr real_t bears = 100.0;
   const std::string loose =
      freedoms.Validate(pairs, bears * tolerance.momentum);
   if (!loose.empty())
   {
      return record.report.Fail(loose);
   }
   for (ContactPair *pair : pairs)
   {
      pair->Enforcement().Store(stage.time);
   }
   return true;
}

bool StageSolver::SolveSliding(ImplicitStage &stage,
                               ResidualTolerance &tolerance,
                               StageContact::Violations &violations)
{
   for (int search = 0;; search++)
   {
      if (!newton.Solve(stage, tolerance, violations))
      {
         return false;
      }
      if (!equations.Bodies().IsLinear() && !violations.within_tolerance)
      {
         return true;
      }
      // Points near an edge may go back and forth.
      if (search == options.tuning.newton.max_searches ||
          !contact.SearchDrifted(stage))
      {
         return true;
      }
   }
}

void StageSolver::Augment(ImplicitStage &stage, ResidualTolerance &tolerance,
                          const StageContact::Violations &violations)
{
   bool stiffened = false;
   for (std::size_t i = 0; i < pairs.size(); i++)
   {
      AugmentedLagrangian &enforcement = pairs[i]->Enforcement();
      enforcement.Augment();
      stiffened = enforcement.StiffenIfSlow(violations.pairs[i],
                                            violations.peak_pressure) ||
                  stiffened;
   }
   contact.Update(stage);
   if (stiffened)
   {
      // Larger penalties make more round-off.
      tolerance = rule.Find(stage, linear.ForcePerVolume());
   }
   record.report.augmentations++;
}

bool StageSolver::FailAugmentations(const StageContact::Violations &violations)
{
   std::string left;
   for (std::size_t i = 0; i < pairs.size(); i++)
   {
      left += "; " + pairs[i]->Name() + ": gap " +
              ToText(violations.pairs[i].penetration) + " (tolerance " +
              ToText(pairs[i]->Scales().gap_tolerance) + "), pressure jump " +
              ToText(violations.pairs[i].pressure_jump) + " (peak pressure " +
              ToText(violations.peak_pressure) + ")";
   }
   return record.report.Fail("gap or pressure jump out of tolerance after " +
                             std::to_string(options.max_augmentations) +
                             " augmentations" + left);
}

} // namespace synovia
