#include "synovia/physics/biphasic_operator.hpp"
#include "synovia/contact/contact_friction.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/phase_timer.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/general/text.hpp"

#include <algorithm>
#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
std::unique_ptr<BodyForm>
MakeTimed(real_t &counter,
          const std::function<std::unique_ptr<BodyForm>()> &make_bodies)
{
   const PhaseTimer timer(counter, "assembly");
   return make_bodies();
}

// Throws Error where a stage's rigid bodies displace points otherwise than
// prescribed, as u has it.
void VerifyTies(const RigidTies &ties, const Array<int> &prescribed,
                const Vector &u, const ImplicitStage &stage)
{
   // Of the displacement.
   constexpr real_t alike = 1e-8;
   MPI_Comm comm = ties.GetComm();
   real_t difference = 0.0;
   real_t size = 0.0;
   for (const int dof : ties.Dofs())
   {
      size = std::max(size, std::abs(stage.u[dof]));
      if (prescribed.FindSorted(dof) >= 0)
      {
         difference = std::max(difference, std::abs(u[dof] - stage.u[dof]));
      }
   }
   size = MaxOverRanks(size, comm);
   if (AnyRank(difference > alike * size, comm))
   {
      throw Error("at points that are tied to a rigid body, another "
                  "displacement is prescribed than the body's, by up to " +
                  ToText(MaxOverRanks(difference, comm)) +
                  " at t = " + ToText(stage.time) +
                  "; prescribe the same, or leave it free");
   }
}
} // namespace

BiphasicOperator::BiphasicOperator(
   BiphasicSpaces &spaces_, const std::vector<Body> &body_list,
   const std::function<std::unique_ptr<BodyForm>()> &make_bodies,
   BoundaryConditions &conditions_, std::vector<ContactPair *> pairs_,
   std::vector<TiedInterface *> interfaces_, const NonlinearOptions &options_)
   : TimeDependentOperator(0, 0.0, IMPLICIT), spaces(spaces_),
     conditions(conditions_), pairs(std::move(pairs_)),
     interfaces(std::move(interfaces_)), options(options_),
     equations(spaces, conditions, pairs, interfaces,
               MakeTimed(record.times.assembly, make_bodies)),
     start(MakeFirstApproach(body_list, spaces, conditions, pairs)),
     carried(body_list, spaces, conditions.RigidBodies(), equations.Ties()),
     solver(body_list, spaces, conditions, pairs, interfaces, start, equations,
            options, record)
{
   height = width =
      spaces.Offsets().Last() + equations.Bodies().ConservedSize();
   balance.support.SetSize(spaces.Offsets()[1]);
   balance.support = 0.0;
   balance.loads = balance.support;
   record.work.assemblies++;
   poses = equations.Ties().Fit(start.displacement, equations.Ties().Rest());
   AcceptStep();
}

void BiphasicOperator::ImplicitSolve(const real_t dt, const Vector &x,
                                     Vector &k)
{
   const Array<int> &offsets = spaces.Offsets();
   const int nu = offsets[1];
   const int np = offsets[2] - nu;
   k.SetSize(height);
   if (!record.report.converged)
   {
      // An earlier stage of the step failed: there is nothing to go on from.
      k = 0.0;
      return;
   }
   ImplicitStage stage = StartStage(dt, x);
   const TouchRule touch = started ? TouchRule::traction : TouchRule::nearness;
   started = true;
   solver.Solve(stage, touch);
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
   rates.Add(stage.time, dt, k);
   balance = equations.Balance(stage);
   poses = stage.poses;
   equations.Ties().Shorten(poses);
}

ImplicitStage BiphasicOperator::StartStage(real_t dt, const Vector &x)
{
   const int nu = spaces.Offsets()[1];
   const int np = spaces.Offsets()[2] - nu;
   ImplicitStage stage;
   stage.dt = dt;
   stage.time = GetTime();
   x.HostRead();
   stage.u0.SetSize(nu);
   stage.p0.SetSize(np);
   stage.conserved0.SetSize(equations.Bodies().ConservedSize());
   for (int i = 0; i < nu; i++)
   {
      stage.u0[i] = x[i];
   }
   for (int i = 0; i < np; i++)
   {
      stage.p0[i] = x[nu + i];
   }
   for (int i = 0; i < stage.conserved0.Size(); i++)
   {
      stage.conserved0[i] = x[nu + np + i];
   }
   const Vector expected = rates.Expected(stage.time);
   if (!equations.Bodies().IsLinear())
   {
      Guess(0.0, expected, stage);
      stage.rest = {stage.u, stage.p, stage.poses};
   }
   Guess(dt, expected, stage);
   conditions.GetLoads(stage.time, stage.momentum_load, stage.mass_load);
   const Vector pressure_rate(const_cast<Vector &>(rates.Last()), nu, np);
   equations.Bodies().StartStage(stage, pressure_rate, rates.LastLength());
   const bool no_guess =
      MaxOverRanks(rates.Last().Normlinf(), spaces.GetComm()) == 0.0;
   if (carried.Any())
   {
      stage.carried = CarriedAlong(stage);
   }
   if (no_guess && equations.Bodies().IsLinear())
   {
      stage.from_start = true;
   }
   else if (no_guess || !equations.Bodies().Validate(stage).empty())
   {
      stage.BeginAnew();
   }
   return stage;
}

void BiphasicOperator::Guess(real_t dt, const Vector &rate,
                             ImplicitStage &stage)
{
   stage.u = stage.u0;
   stage.p = stage.p0;
   stage.u.HostReadWrite();
   stage.p.HostReadWrite();
   for (int i = 0; i < stage.u.Size(); i++)
   {
      stage.u[i] += dt * rate[i];
   }
   for (int i = 0; i < stage.p.Size(); i++)
   {
      stage.p[i] += dt * rate[stage.u.Size() + i];
   }
   conditions.SetDisplacement(stage.time, stage.u);
   conditions.SetPressure(stage.time, stage.p);
   const RigidTies &ties = equations.Ties();
   stage.poses = ties.Fit(stage.u, poses);
   ties.Prescribe(stage.time, stage.poses);
   if (dt > 0.0 && carried.Any())
   {
      GuessCarried(dt, rate, stage);
   }
   const Vector prescribed(stage.u);
   ties.Write(stage.poses, stage.u);
   VerifyTies(ties, conditions.DisplacementDofs(), prescribed, stage);
}

void BiphasicOperator::GuessCarried(real_t dt, const Vector &rate,
                                    ImplicitStage &stage) const
{
   const RigidTies &ties = equations.Ties();
   const RigidPoses begin = ties.Fit(stage.u0, poses);
   Vector before(stage.u0);
   for (int i = 0; i < before.Size(); i++)
   {
      before[i] -= dt * rate[i];
   }
   carried.Carry(ties.Fit(before, begin), begin, before);
   Vector expected(stage.u0);
   expected *= 2.0;
   expected -= before;
   carried.Carry(begin, stage.poses, expected);
   carried.Copy(expected, stage.u);
   conditions.SetDisplacement(stage.time, stage.u);
}

std::optional<ImplicitStage::State>
BiphasicOperator::CarriedAlong(const ImplicitStage &stage) const
{
   // Rotations to first order stretch by half the square of the angle (rad).
   constexpr real_t least_turn = 0.02;
   const RigidTies &ties = equations.Ties();
   const RigidPoses begin = ties.Fit(stage.u0, poses);
   if (carried.Turn(begin, stage.poses) < least_turn)
   {
      return std::nullopt;
   }
   ImplicitStage along(stage);
   along.u = stage.u0;
   along.p = stage.p0;
   carried.Carry(begin, stage.poses, along.u);
   conditions.SetDisplacement(stage.time, along.u);
   conditions.SetPressure(stage.time, along.p);
   ties.Write(stage.poses, along.u);
   if (!equations.Bodies().Validate(along).empty())
   {
      return std::nullopt;
   }
   return ImplicitStage::State{along.u, along.p, stage.poses};
}

WorkCounts BiphasicOperator::Work() const
{
   WorkCounts all(record.work);
   all += solver.LinearSolver().Work();
   return all;
}

void BiphasicOperator::BeginStep(const Vector &x)
{
   const bool failed = !record.report.converged;
   record.report = SolveReport();
   const PhaseTimer timer(record.times.search, "search");
   const Vector u(const_cast<Vector &>(x), 0, spaces.Offsets()[1]);
   for (ContactPair *pair : pairs)
   {
      pair->StartStep(u, failed);
   }
}

void BiphasicOperator::AcceptStep()
{
   accepted.rates = rates;
   accepted.started = started;
   accepted.balance = balance;
   accepted.poses = poses;
   accepted.drained = equations.DrainedDofs();
   for (ContactPair *pair : pairs)
   {
      pair->Enforcement().Accept();
   }
   for (TiedInterface *tie : interfaces)
   {
      tie->Accept();
   }
}

void BiphasicOperator::ForgetRate()
{
   rates.Forget();
   for (ContactPair *pair : pairs)
   {
      pair->Enforcement().ForgetPast();
   }
   for (TiedInterface *tie : interfaces)
   {
      tie->ForgetPast();
   }
}

void BiphasicOperator::BeginAnew(real_t t, const Vector &u)
{
   conditions.SetOrigins(t, u);
   equations.Ties().SetOrigins(t, poses);
   ForgetRate();
   for (ContactPair *pair : pairs)
   {
      if (ContactFriction *friction = pair->Enforcement().Friction())
      {
         friction->SetOrigin(u);
      }
   }
   AcceptStep();
}

void BiphasicOperator::RejectStep()
{
   rates = accepted.rates;
   started = accepted.started;
   balance = accepted.balance;
   poses = accepted.poses;
   equations.SetDrainedDofs(accepted.drained);
   for (ContactPair *pair : pairs)
   {
      pair->Enforcement().Restore();
   }
   for (TiedInterface *tie : interfaces)
   {
      tie->Restore();
   }
}

void BiphasicOperator::Archive(StateArchive &archive)
{
   accepted.rates.Archive(archive);
   archive.Flag("started", accepted.started);
   RigidTies &ties = equations.Ties();
   for (int b = 0; b < ties.Bodies(); b++)
   {
      for (int i = 0; i < 6; i++)
      {
         archive.Number("rigid_body." + ties.Name(b) + "." + std::to_string(i),
                        accepted.poses[b][i]);
      }
   }
   for (int j = 0; j < ties.Joints(); j++)
   {
      for (int i = 0; i < 6; i++)
      {
         archive.Number("joint." + equations.Joints().Name(j) + ".drive." +
                           std::to_string(i),
                        accepted.poses[ties.DriveOf(j)][i]);
      }
   }
   ties.Archive(archive);
   conditions.Archive(archive);
   const bool may_be_pushed = equations.Rigid().Any() || ties.Any();
   if (may_be_pushed)
   {
      archive.Field("start.displacement", spaces.Displacement(),
                    start.displacement);
   }
   for (ContactPair *pair : pairs)
   {
      pair->Archive(archive);
   }
   for (TiedInterface *tie : interfaces)
   {
      tie->Archive(archive);
   }
   if (archive.Reads())
   {
      rates = accepted.rates;
      started = accepted.started;
      poses = accepted.poses;
      if (may_be_pushed)
      {
         for (ContactPair *pair : pairs)
         {
            pair->SearchAt(start.displacement);
         }
      }
   }
}

} // namespace synovia
