#include "synovia/physics/biphasic_operator.hpp"
#include "synovia/fem/node_positions.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/general/text.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace synovia
{

using namespace mfem;

namespace
{
/// Adds the time that it lives to a counter.
class PhaseTimer
{
public:
   explicit PhaseTimer(real_t &counter_) : counter(counter_) { watch.Start(); }
   ~PhaseTimer() { counter += watch.RealTime(); }
   PhaseTimer(const PhaseTimer &) = delete;
   PhaseTimer &operator=(const PhaseTimer &) = delete;

private:
   real_t &counter;
   StopWatch watch;
};

std::unique_ptr<BodyForm>
MakeTimed(real_t &counter,
          const std::function<std::unique_ptr<BodyForm>()> &make_bodies)
{
   const PhaseTimer timer(counter);
   return make_bodies();
}
} // namespace

BiphasicOperator::BiphasicOperator(
   BiphasicSpaces &spaces_, const std::vector<Body> &body_list,
   const std::function<std::unique_ptr<BodyForm>()> &make_bodies,
   BoundaryConditions &conditions_, std::vector<ContactPair *> pairs_,
   const NonlinearOptions &options_)
   : TimeDependentOperator(0, 0.0, IMPLICIT), spaces(spaces_),
     conditions(conditions_), pairs(std::move(pairs_)), options(options_),
     equations(spaces, conditions, pairs,
               MakeTimed(times.assembly, make_bodies)),
     freedoms(body_list, spaces, conditions),
     start(MakeFirstApproach(body_list, spaces, conditions, pairs))
{
   height = width =
      spaces.Offsets().Last() + equations.Bodies().ConservedSize();
   rate.SetSize(height);
   rate = 0.0;
   balance.support.SetSize(spaces.Offsets()[1]);
   balance.support = 0.0;
   work.assemblies++;
   {
      const PhaseTimer timer(times.setup);
      linear = std::make_unique<BiphasicLinearSolver>(
         equations.Jacobian(), spaces, options.linear, options.tuning);
   }
   if (equations.Rigid().Any())
   {
      Vector low;
      Vector high;
      spaces.GetMesh().GetBoundingBox(low, high);
      extent = high.DistanceTo(low);
   }
   AcceptStep();
}

void BiphasicOperator::ImplicitSolve(const real_t dt, const Vector &x,
                                     Vector &k)
{
   const Array<int> &offsets = spaces.Offsets();
   const int nu = offsets[1];
   const int np = offsets[2] - nu;
   k.SetSize(height);
   if (!report.converged)
   {
      // An earlier stage of the step failed: there is nothing to go on from.
      k = 0.0;
      return;
   }
   Stage stage;
   stage.dt = dt;
   stage.time = GetTime();
   stage.u0.SetSize(nu);
   stage.p0.SetSize(np);
   const real_t *start = x.HostRead();
   for (int i = 0; i < nu; i++)
   {
      stage.u0[i] = start[i];
   }
   for (int i = 0; i < np; i++)
   {
      stage.p0[i] = start[nu + i];
   }
   stage.conserved0.SetSize(equations.Bodies().ConservedSize());
   for (int i = 0; i < stage.conserved0.Size(); i++)
   {
      stage.conserved0[i] = start[nu + np + i];
   }
   SolveStage(stage);
   for (const Vector *values : {&stage.u, &stage.u0, &stage.p, &stage.p0})
   {
      values->HostRead();
   }
   real_t *slope = k.HostWrite();
   for (int i = 0; i < nu; i++)
   {
      slope[i] = (stage.u[i] - stage.u0[i]) / dt;
   }
   for (int i = 0; i < np; i++)
   {
      slope[nu + i] = (stage.p[i] - stage.p0[i]) / dt;
   }
   Vector conserved;
   equations.Bodies().GetConserved(stage.u, conserved);
   for (int i = 0; i < conserved.Size(); i++)
   {
      slope[nu + np + i] = (conserved[i] - stage.conserved0[i]) / dt;
   }
   rate = k;
   rate_dt = dt;
   balance = equations.Balance(stage);
}

WorkCounts BiphasicOperator::Work() const
{
   WorkCounts all(work);
   all += linear->Work();
   return all;
}

void BiphasicOperator::AcceptStep()
{
   accepted.rate = rate;
   accepted.rate_dt = rate_dt;
   accepted.started = started;
   accepted.balance = balance;
   accepted.drained = equations.DrainedDofs();
   for (ContactPair *pair : pairs)
   {
      pair->Enforcement().Accept();
   }
}

void BiphasicOperator::ForgetRate()
{
   rate = 0.0;
   for (ContactPair *pair : pairs)
   {
      pair->Enforcement().ForgetPast();
   }
}

void BiphasicOperator::RejectStep()
{
   rate = accepted.rate;
   rate_dt = accepted.rate_dt;
   started = accepted.started;
   balance = accepted.balance;
   equations.SetDrainedDofs(accepted.drained);
   for (ContactPair *pair : pairs)
   {
      pair->Enforcement().Restore();
   }
}

void BiphasicOperator::Archive(StateArchive &archive)
{
   Vector velocity(accepted.rate, 0, spaces.Offsets()[1]);
   Vector pressure_rate(accepted.rate, spaces.Offsets()[1],
                        spaces.Offsets()[2] - spaces.Offsets()[1]);
   archive.Field("rate.displacement", spaces.Displacement(), velocity);
   archive.Field("rate.pressure", spaces.Pressure(), pressure_rate);
   archive.Number("rate.length", accepted.rate_dt);
   archive.Flag("started", accepted.started);
   if (equations.Rigid().Any())
   {
      archive.Field("start.displacement", spaces.Displacement(),
                    start.displacement);
   }
   for (ContactPair *pair : pairs)
   {
      pair->Archive(archive);
   }
   if (archive.Reads())
   {
      rate = accepted.rate;
      rate_dt = accepted.rate_dt;
      started = accepted.started;
      if (equations.Rigid().Any())
      {
         for (ContactPair *pair : pairs)
         {
            pair->SearchAt(start.displacement);
         }
      }
   }
}

bool BiphasicOperator::Fail(const std::string &reason)
{
   report.converged = false;
   report.reason = reason;
   return false;
}

bool BiphasicOperator::FailSolve(const std::string &reason)
{
   const std::string loose = freedoms.Validate(pairs, 0.0);
   return Fail(loose.empty() ? reason : loose + " (" + reason + ")");
}

void BiphasicOperator::Search(const Stage &stage)
{
   const PhaseTimer timer(times.search);
   if (equations.SearchContact(stage))
   {
      linear->ContactMoved();
      report.searches++;
      work.searches++;
   }
}

void BiphasicOperator::LinearizeContact(const Stage &stage)
{
   const PhaseTimer timer(times.assembly);
   if (equations.LinearizeContact(stage))
   {
      linear->TangentChanged();
   }
}

bool BiphasicOperator::SearchDrifted(Stage &stage)
{
   bool drifted = false;
   for (ContactPair *pair : pairs)
   {
      drifted = pair->HasDrifted() || drifted;
   }
   if (drifted)
   {
      Search(stage);
      equations.EvaluateContact(stage);
      UpdateContact(stage);
      equations.UpdateDrainedDofs(stage);
   }
   return drifted;
}

bool BiphasicOperator::UpdateContact(Stage &stage)
{
   bool changed = false;
   unsettled.clear();
   for (ContactPair *pair : pairs)
   {
      if (pair->Enforcement().UpdateActiveSet())
      {
         changed = true;
         unsettled += (unsettled.empty() ? "" : ", ") + pair->Name();
      }
   }
   changed = CatchPushed(stage) || changed;
   if (changed)
   {
      equations.UpdateDrainedDofs(stage);
   }
   return changed;
}

bool BiphasicOperator::CatchPushed(Stage &stage)
{
   bool caught = false;
   for (const PushedBodies &group : start.pushed)
   {
      if (!group.PushesAt(stage.time) || group.AreHeldBy(pairs))
      {
         continue;
      }
      const real_t distance = group.Clearance(pairs);
      if (!std::isfinite(distance))
      {
         continue;
      }
      stage.u.Add(distance, group.translation);
      for (ContactPair *pair : pairs)
      {
         pair->Enforcement().Evaluate(stage.u, stage.p);
         pair->Enforcement().UpdateActiveSet(TouchRule::nearness);
      }
      caught = true;
   }
   return caught;
}

bool BiphasicOperator::SolveStage(Stage &stage)
{
   const int nu = stage.u0.Size();
   stage.u = stage.u0;
   stage.p = stage.p0;
   rate.HostRead();
   for (int i = 0; i < nu; i++)
   {
      stage.u[i] += stage.dt * rate[i];
   }
   for (int i = 0; i < stage.p.Size(); i++)
   {
      stage.p[i] += stage.dt * rate[nu + i];
   }
   conditions.SetDisplacement(stage.time, stage.u);
   conditions.SetPressure(stage.time, stage.p);
   conditions.GetLoads(stage.time, stage.momentum_load, stage.mass_load);
   const Vector pressure_rate(rate, nu, stage.p.Size());
   equations.Bodies().StartStage(stage, pressure_rate, rate_dt);
   ChooseStart(stage);
   equations.SetTimeStep(stage.dt);

   Search(stage);
   for (ContactPair *pair : pairs)
   {
      AugmentedLagrangian &enforcement = pair->Enforcement();
      enforcement.StartStage(stage.time);
      enforcement.Evaluate(stage.u, stage.p);
      enforcement.UpdateActiveSet(started ? TouchRule::traction
                                          : TouchRule::nearness);
   }
   started = true;
   CatchPushed(stage);
   equations.UpdateDrainedDofs(stage);
   ResidualTolerance tolerance = Tolerance(stage);
   for (int augmentation = 0;; augmentation++)
   {
      if (!SolveSliding(stage, tolerance))
      {
         return false;
      }
      const Violations violations = FindViolations(stage);
      if (violations.within_tolerance)
      {
         break;
      }
      if (augmentation == options.max_augmentations)
      {
         std::string left;
         for (size_t i = 0; i < pairs.size(); i++)
         {
            left += "; " + pairs[i]->Name() + ": gap " +
                    ToText(violations.pairs[i].penetration) + " (tolerance " +
                    ToText(pairs[i]->Scales().gap_tolerance) +
                    "), pressure jump " +
                    ToText(violations.pairs[i].pressure_jump) +
                    " (peak pressure " + ToText(violations.peak_pressure) + ")";
         }
         return Fail("gap or pressure jump out of tolerance after " +
                     std::to_string(augmentation) + " augmentations" + left);
      }
      bool stiffened = false;
      for (size_t i = 0; i < pairs.size(); i++)
      {
         AugmentedLagrangian &enforcement = pairs[i]->Enforcement();
         enforcement.Augment();
         stiffened = enforcement.StiffenIfSlow(violations.pairs[i],
                                               violations.peak_pressure) ||
                     stiffened;
      }
      UpdateContact(stage);
      if (stiffened)
      {
         // Larger penalties make more round-off.
         tolerance = Tolerance(stage);
      }
      report.augmentations++;
   }
   // Residuals may be forces of contact that bears nothing.
   constexpr real_t bears = 100.0;
   const std::string loose =
      freedoms.Validate(pairs, bears * tolerance.momentum);
   if (!loose.empty())
   {
      return Fail(loose);
   }
   for (ContactPair *pair : pairs)
   {
      pair->Enforcement().Store(stage.time);
   }
   return true;
}

BiphasicOperator::Violations
BiphasicOperator::FindViolations(const Stage &stage) const
{
   Violations violations;
   violations.peak_pressure = MaxOverRanks(
      stage.p.Size() > 0 ? stage.p.Normlinf() : 0.0, spaces.GetComm());
   for (const ContactPair *pair : pairs)
   {
      const AugmentedLagrangian &enforcement = pair->Enforcement();
      violations.pairs.push_back(enforcement.FindViolations());
      violations.within_tolerance =
         enforcement.IsWithinTolerance(violations.pairs.back(),
                                       violations.peak_pressure) &&
         violations.within_tolerance;
   }
   return violations;
}

bool BiphasicOperator::SolveSliding(Stage &stage, ResidualTolerance &tolerance)
{
   for (int search = 0;; search++)
   {
      if (!SolveContact(stage, tolerance))
      {
         return false;
      }
      if (!equations.Bodies().IsLinear() &&
          !FindViolations(stage).within_tolerance)
      {
         return true;
      }
      // Points near an edge may go back and forth.
      if (search == options.tuning.newton.max_searches || !SearchDrifted(stage))
      {
         return true;
      }
   }
}

bool BiphasicOperator::SolveContact(Stage &stage, ResidualTolerance &tolerance)
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
      real_t norm = linear->Norm(residual, tolerance);
      if (norm <= 1.0 && stage.from_start)
      {
         stage.from_start = false;
         equations.ComputeResidual(stage, residual);
         norm = linear->Norm(residual, tolerance);
      }
      if (norm <= 1.0 && Tighten(stage, tolerance))
      {
         norm = linear->Norm(residual, tolerance);
      }
      if (norm <= 1.0)
      {
         return true;
      }
      if (!std::isfinite(norm))
      {
         return Fail("the residual is not a finite number");
      }
      first_norm = iteration == 0 ? norm : first_norm;
      if (evaluated && norm <= fallen * first_norm &&
          !FindViolations(stage).within_tolerance)
      {
         return true;
      }
      if (!stage.from_start)
      {
         Linearize(stage);
      }
      LinearizeContact(stage);
      StopWatch watch;
      watch.Start();
      const BiphasicLinearSolver::Result result =
         linear->Solve(residual, step, tolerance, LinearTarget(norm, forcing));
      step.SyncToBlocks();
      times.setup += result.setup_seconds;
      times.linear += watch.RealTime() - result.setup_seconds;
      report.newton++;
      report.linear += result.iterations;
      report.most_linear = std::max(report.most_linear, result.iterations);
      report.decades += result.decades;
      if (!result.failure.empty())
      {
         return Fail(result.failure);
      }
      equations.Rigid().Distribute(step.GetBlock(0));
      if (Escapes(step.GetBlock(0)))
      {
         return false;
      }
      if (!result.converged)
      {
         return FailSolve("the linear solver did not converge in " +
                          std::to_string(result.iterations) + " iterations");
      }
      if (!TakeStep(step, norm, tolerance, stage, residual))
      {
         return false;
      }
      evaluated = !UpdateContact(stage) && !equations.Bodies().IsLinear();
   }
   return Fail(unsettled.empty()
                  ? "Newton's method did not converge in " +
                       std::to_string(options.max_newton) + " iterations"
                  : "the contact's active set did not settle in " +
                       std::to_string(options.max_newton) +
                       " iterations: " + unsettled);
}

void BiphasicOperator::ChooseStart(Stage &stage)
{
   const bool no_guess = MaxOverRanks(rate.Normlinf(), spaces.GetComm()) == 0.0;
   stage.from_start = no_guess || !equations.Bodies().Validate(stage).empty();
   if (stage.from_start)
   {
      BodyStage start(stage);
      start.u = stage.u0;
      start.p = stage.p0;
      Linearize(start);
   }
}

void BiphasicOperator::Linearize(const BodyStage &stage)
{
   const PhaseTimer timer(times.assembly);
   if (equations.LinearizeBodies(stage))
   {
      work.assemblies++;
      linear->TangentChanged();
   }
}

real_t BiphasicOperator::LinearTarget(real_t norm, ForcingTerm &forcing) const
{
   if (equations.Bodies().IsLinear())
   {
      // What decides the active set need not be exact; a settled set is solved
      // to the end.
      const real_t part = pairs.empty() ? 0.0 : options.active_set_tolerance;
      return std::max(1.0, part * norm);
   }
   // What the linear system leaves must not spoil the last iteration.
   const real_t end = options.tuning.newton.final_accuracy;
   const bool inexact = options.active_set_tolerance > 0.0;
   return inexact ? std::max(end, forcing.Next(norm) * norm) : end;
}

bool BiphasicOperator::TakeStep(const BlockVector &step, real_t norm,
                                const ResidualTolerance &tolerance,
                                Stage &stage, BlockVector &residual)
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
   return obstacle.empty() || Fail(obstacle);
}

std::string BiphasicOperator::FindObstacle(const Stage &stage, real_t norm,
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
   const real_t now = linear->Norm(residual, tolerance);
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

Point3 BiphasicOperator::WorstPlace(const BlockVector &residual) const
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

bool BiphasicOperator::Escapes(const Vector &step)
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
