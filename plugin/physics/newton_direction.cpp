#include "synovia/physics/newton_direction.hpp"
#include "synovia/general/phase_timer.hpp"
#include "synovia/general/text.hpp"

#include <algorithm>
#include <cmath>

namespace synovia
{

using namespace mfem;

NewtonDirection::NewtonDirection(BiphasicSpaces &spaces,
                                 StageEquations &equations_,
                                 const std::vector<ContactPair *> &pairs_,
                                 const RigidFreedoms &freedoms_,
                                 BiphasicLinearSolver &linear_,
                                 SolveRecord &record_)
   : equations(equations_), pairs(pairs_), freedoms(freedoms_), linear(linear_),
     record(record_)
{
   if (equations.Rigid().Any() || equations.Ties().Any())
   {
      Vector low;
      Vector high;
      spaces.GetMesh().GetBoundingBox(low, high);
      extent = high.DistanceTo(low);
   }
}

void NewtonDirection::LinearizeStart(const ImplicitStage &stage)
{
   if (stage.from_start)
   {
      BodyStage start(stage);
      start.u = stage.u0;
      start.p = stage.p0;
      LinearizeBodies(start);
   }
}

void NewtonDirection::Linearize(const ImplicitStage &stage)
{
   if (!stage.from_start)
   {
      LinearizeBodies(stage);
   }
   const PhaseTimer timer(record.times.assembly, "assembly");
   if (equations.LinearizeContact(stage))
   {
      linear.TangentChanged();
   }
   equations.LinearizeTies(stage);
}

void NewtonDirection::KeepTangent()
{
   const PhaseTimer timer(record.times.assembly, "assembly");
   equations.KeepContactTangent();
   linear.ContactFollowed();
}

void NewtonDirection::LinearizeBodies(const BodyStage &stage)
{
   const PhaseTimer timer(record.times.assembly, "assembly");
   if (equations.LinearizeBodies(stage))
   {
      record.work.assemblies++;
      linear.TangentChanged();
   }
}

bool NewtonDirection::Solve(const BlockVector &residual, real_t target,
                            const ResidualTolerance &tolerance,
                            BlockVector &step, FirstGuess guess)
{
   solution.SetSize(residual.Size());
   return Finish(
      [&]
      { return linear.Solve(residual, solution, tolerance, target, guess); },
      step);
}

bool NewtonDirection::Solve(const BlockVector &residual, real_t target,
                            const ResidualTolerance &tolerance,
                            real_t compliance, BlockVector &step,
                            MultiplierChanges &changes)
{
   return Finish(
      [&]
      {
         return linear.Solve(residual, solution, changes, compliance, tolerance,
                             target);
      },
      step);
}

bool NewtonDirection::Finish(
   const std::function<BiphasicLinearSolver::Result()> &solve,
   BlockVector &step)
{
   SolveReport &report = record.report;
   const ProfiledPhase phase("iteration");
   StopWatch watch;
   watch.Start();
   const BiphasicLinearSolver::Result result = solve();
   // Of the last step, blocks may have been used on the host.
   solution.HostRead();
   step.HostWrite();
   static_cast<Vector &>(step) = solution;
   step.SyncToBlocks();
   record.times.setup += result.setup_seconds;
   record.times.linear += watch.RealTime() - result.setup_seconds;
   report.newton++;
   report.linear += result.iterations;
   report.most_linear = std::max(report.most_linear, result.iterations);
   report.decades += result.decades;
   if (!result.failure.empty())
   {
      return report.Fail(result.failure);
   }
   equations.Rigid().Distribute(step.GetBlock(0));
   if (Escapes(step.GetBlock(0)))
   {
      return false;
   }
   return result.converged ||
          FailSolve("the linear solver did not converge in " +
                    std::to_string(result.iterations) + " iterations");
}

bool NewtonDirection::FailSolve(const std::string &reason)
{
   const std::string loose =
      freedoms.Validate(pairs, 0.0, equations.ResistingLigaments());
   return record.report.Fail(loose.empty() ? reason
                                           : loose + " (" + reason + ")");
}

bool NewtonDirection::Escapes(const Vector &step)
{
   // Where little touches yet, a first guess may go far; without resistance
   // only round-off is left to resist.
   constexpr real_t away = 1e6;
   const RigidTies &ties = equations.Ties();
   const Vector amounts = ties.Gather(step);
   for (int k = 0; k < amounts.Size(); k++)
   {
      if (ties.IsFreedom(ties.Slots()[k]) &&
          !(std::abs(amounts[k]) <= away * extent))
      {
         FailSolve("the loads on the rigid body \"" +
                   ties.Name(ties.Slots()[k].body) + "\" would move it by " +
                   ToText(amounts[k]));
         return true;
      }
   }
   for (const RigidSurfaces::Travel &travel : equations.Rigid().GetTravel(step))
   {
      if (!(std::abs(travel.distance) <= away * extent))
      {
         FailSolve("the force on \"" + travel.name + "\" would move it by " +
                   ToText(travel.distance));
         return true;
      }
   }
   return false;
}

} // namespace synovia
