#include "synovia/physics/biphasic_newton_solver.hpp"
#include "synovia/fem/node_positions.hpp"
#include "synovia/general/phase_timer.hpp"
#include "synovia/general/text.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace synovia
{

using namespace mfem;

BiphasicNewtonSolver::BiphasicNewtonSolver(
   BiphasicSpaces &spaces_, StageEquations &equations_, StageContact &contact_,
   const RigidFreedoms &freedoms_, const ToleranceRule &rule_,
   BiphasicLinearSolver &linear_, const NonlinearOptions &options_,
   SolveRecord &record_)
   : spaces(spaces_), equations(equations_), contact(contact_),
     freedoms(freedoms_), rule(rule_), linear(linear_), options(options_),
     record(record_)
{
   if (equations.Rigid().Any())
   {
      Vector low;
      Vector high;
      spaces.GetMesh().GetBoundingBox(low, high);
      extent = high.DistanceTo(low);
   }
}

bool BiphasicNewtonSolver::Solve(ImplicitStage &stage,
                                 ResidualTolerance &tolerance,
                                 StageContact::Violations &violations)
{
   // Of the residual, for gaps to be known well enough to correct multipliers.
   constexpr real_t fallen = 0.1;
   BlockVector residual(spaces.Offsets());
   BlockVector step(spaces.Offsets());
   ForcingTerm forcing(options.tuning.newton);
   bool evaluated = false;
   real_t first_norm = 0.0;
   for (int iteration = 0; iteration < options.max_newton; iteration++)
   {
      if (!evaluated)
      {
         equations.ComputeResidual(stage, residual);
      }
      real_t norm = linear.Norm(residual, tolerance);
      if (norm <= 1.0 && stage.from_start)
      {
         stage.from_start = false;
         equations.ComputeResidual(stage, residual);
         norm = linear.Norm(residual, tolerance);
      }
      if (norm <= 1.0 && rule.Tighten(stage, tolerance))
      {
         norm = linear.Norm(residual, tolerance);
      }
      if (!std::isfinite(norm))
      {
         return record.report.Fail("the residual is not a finite number");
      }
      first_norm = iteration == 0 ? norm : first_norm;
      if (norm <= 1.0 || (evaluated && norm <= fallen * first_norm))
      {
         violations = contact.FindViolations(stage);
         if (norm <= 1.0 || !violations.within_tolerance)
         {
            return true;
         }
      }
      if (!stage.from_start)
      {
         LinearizeBodies(stage);
      }
      LinearizeContact(stage);
      if (!SolveLinear(residual, norm, tolerance, forcing, step) ||
          !TakeStep(step, norm, tolerance, stage, residual))
      {
         return false;
      }
      evaluated = !contact.Update(stage) && !equations.Bodies().IsLinear();
   }
   return record.report.Fail(
      contact.Unsettled().empty()
         ? "Newton's method did not converge in " +
              std::to_string(options.max_newton) + " iterations"
         : "the contact's active set did not settle in " +
              std::to_string(options.max_newton) +
              " iterations: " + contact.Unsettled());
}

void BiphasicNewtonSolver::LinearizeStart(const ImplicitStage &stage)
{
   if (stage.from_start)
   {
      BodyStage start(stage);
      start.u = stage.u0;
      start.p = stage.p0;
      LinearizeBodies(start);
   }
}

void BiphasicNewtonSolver::LinearizeBodies(const BodyStage &stage)
{
   const PhaseTimer timer(record.times.assembly);
   if (equations.LinearizeBodies(stage))
   {
      record.work.assemblies++;
      linear.TangentChanged();
   }
}

void BiphasicNewtonSolver::LinearizeContact(const ImplicitStage &stage)
{
   const PhaseTimer timer(record.times.assembly);
   if (equations.LinearizeContact(stage))
   {
      linear.TangentChanged();
   }
}

bool BiphasicNewtonSolver::SolveLinear(const BlockVector &residual, real_t norm,
                                       const ResidualTolerance &tolerance,
                                       ForcingTerm &forcing, BlockVector &step)
{
   SolveReport &report = record.report;
   StopWatch watch;
   watch.Start();
   const BiphasicLinearSolver::Result result =
      linear.Solve(residual, step, tolerance, LinearTarget(norm, forcing));
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

real_t BiphasicNewtonSolver::LinearTarget(real_t norm,
                                          ForcingTerm &forcing) const
{
   if (equations.Bodies().IsLinear())
   {
      // What decides the active set need not be exact; a settled set is solved
      // to the end.
      const real_t part =
         contact.Pairs().empty() ? 0.0 : options.active_set_tolerance;
      return std::max(1.0, part * norm);
   }
   // What the linear system leaves must not spoil the last iteration.
   const real_t end = options.tuning.newton.final_accuracy;
   const bool inexact = options.active_set_tolerance > 0.0;
   return inexact ? std::max(end, forcing.Next(norm) * norm) : end;
}

bool BiphasicNewtonSolver::TakeStep(const BlockVector &step, real_t norm,
                                    const ResidualTolerance &tolerance,
                                    ImplicitStage &stage, BlockVector &residual)
{
   const real_t least_share = options.tuning.newton.shortest_step;
   // From the stage's start the step and the supports' increments go together,
   // and what there was is no measure for what there will be.
   const bool whole = stage.from_start;
   stage.from_start = false;
   stage.u += step.GetBlock(0);
   stage.p += step.GetBlock(1);
   if (equations.Bodies().IsLinear())
   {
      equations.EvaluateContact(stage);
      return true;
   }
   const real_t limit = whole ? std::numeric_limits<real_t>::infinity() : norm;
   std::string obstacle = FindObstacle(stage, limit, tolerance, residual);
   for (real_t share = 0.5; !obstacle.empty() && !whole && share >= least_share;
        share *= 0.5)
   {
      stage.u.Add(-share, step.GetBlock(0));
      stage.p.Add(-share, step.GetBlock(1));
      obstacle = FindObstacle(stage, limit, tolerance, residual);
   }
   return obstacle.empty() || record.report.Fail(obstacle);
}

std::string
BiphasicNewtonSolver::FindObstacle(const ImplicitStage &stage, real_t norm,
                                   const ResidualTolerance &tolerance,
                                   BlockVector &residual)
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
   equations.ComputeResidual(stage, residual);
   const real_t now = linear.Norm(residual, tolerance);
   if (now <= std::max(tuning.residual_floor, tuning.residual_growth * norm))
   {
      return "";
   }
   const Point3 place = WorstPlace(residual);
   return "along Newton's direction the residual grows from " + ToText(norm) +
          " to " + ToText(now) + " times its tolerance, most of all at (" +
          ToText(place[0]) + ", " + ToText(place[1]) + ", " + ToText(place[2]) +
          ")";
}

Point3 BiphasicNewtonSolver::WorstPlace(const BlockVector &residual) const
{
   const Vector &forces = residual.GetBlock(0);
   struct
   {
      double size;
      int rank;
   } worst = {-1.0, 0};
   MPI_Comm comm = spaces.GetComm();
   MPI_Comm_rank(comm, &worst.rank);
   const int rank = worst.rank;
   int largest = 0;
   for (int i = 0; i < forces.Size(); i++)
   {
      if (std::abs(forces[i]) > worst.size)
      {
         worst.size = std::abs(forces[i]);
         largest = i;
      }
   }
   MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE_INT, MPI_MAXLOC, comm);
   const Vector positions = NodePositions(spaces.Displacement());
   Point3 place{{0.0, 0.0, 0.0}};
   for (int d = 0; d < 3 && rank == worst.rank; d++)
   {
      // The three components of a node follow each other.
      place[d] = positions[largest / 3 * 3 + d];
   }
   MPI_Bcast(place.data(), 3, MPITypeMap<real_t>::mpi_type, worst.rank, comm);
   return place;
}

bool BiphasicNewtonSolver::FailSolve(const std::string &reason)
{
   const std::string loose = freedoms.Validate(contact.Pairs(), 0.0);
   return record.report.Fail(loose.empty() ? reason
                                           : loose + " (" + reason + ")");
}

bool BiphasicNewtonSolver::Escapes(const Vector &step)
{
   // Where little touches yet, a first guess may go far; without resistance
   // only round-off is left to resist.
   constexpr real_t away = 1e6;
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
