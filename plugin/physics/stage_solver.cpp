#include "synovia/physics/stage_solver.hpp"
#include "synovia/general/phase_timer.hpp"
#include "synovia/physics/augmented_newton.hpp"
#include "synovia/physics/primal_dual_newton.hpp"

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
   const PhaseTimer timer(times.setup, "setup");
   return BiphasicLinearSolver(equations.Jacobian(), spaces, options.linear,
                               options.tuning);
}
} // namespace

StageSolver::StageSolver(const std::vector<Body> &bodies,
                         BiphasicSpaces &spaces, BoundaryConditions &conditions,
                         const std::vector<ContactPair *> &pairs_,
                         const std::vector<TiedInterface *> &interfaces_,
                         const FirstApproach &start, StageEquations &equations_,
                         const NonlinearOptions &options, SolveRecord &record_)
   : pairs(pairs_), interfaces(interfaces_), equations(equations_),
     record(record_), freedoms(bodies, spaces, conditions),
     linear(MakeLinearSolver(equations, spaces, options, record.times)),
     rule(spaces, conditions, pairs, interfaces, equations,
          options.linear.relative_tolerance),
     contact(spaces.GetComm(), pairs, interfaces, start.pushed, equations,
             linear, record),
     direction(spaces, equations, pairs, freedoms, linear, record)
{
   if (equations.Bodies().IsLinear())
   {
      method = std::make_unique<AugmentedNewton>(
         spaces, equations, contact, rule, direction, linear, options, record);
   }
   else
   {
      method = std::make_unique<PrimalDualNewton>(
         spaces, equations, contact, rule, direction, linear, options, record);
   }
}

bool StageSolver::Solve(ImplicitStage &stage, TouchRule touch)
{
   equations.SetTimeStep(stage.dt);
   contact.Start(stage, touch);
   direction.LinearizeStart(stage);
   ResidualTolerance tolerance = rule.Find(stage, linear.ForcePerVolume());
   if (!method->Solve(stage, tolerance))
   {
      return false;
   }
   // Residuals may be forces of contact that bears nothing.
   constexpr real_t bears = 100.0;
   const std::string loose =
      freedoms.Validate(pairs, bears * tolerance.momentum,
                        equations.Ligaments().Resisting(stage.poses));
   if (!loose.empty())
   {
      return record.report.Fail(loose);
   }
   for (ContactPair *pair : pairs)
   {
      pair->Enforcement().Store(stage.time);
   }
   for (TiedInterface *tie : interfaces)
   {
      tie->Store(stage.time);
   }
   return true;
}

} // namespace synovia
