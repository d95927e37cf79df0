#include "synovia/physics/tolerance_rule.hpp"
#include "synovia/general/reduce.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace synovia
{

using namespace mfem;

namespace
{
// The norm of the volumes that surfaces which supports move, such as those of
// rigid bodies, sweep of what they press by a displacement: with no body behind
// them nothing else tells how much of the fluid is to move.
real_t SweptVolume(const std::vector<ContactPair *> &pairs,
                   const Vector &displacement, MPI_Comm comm)
{
   real_t squares = 0.0;
   for (const ContactPair *pair : pairs)
   {
      const ContactFactors factors = pair->Factors();
      const Vector &area = pair->Constraint().Coverage().area;
      Vector rows(factors.gap->Height());
      factors.gap_change->Mult(displacement, rows);
      rows.HostRead();
      for (int j = 0; j < rows.Size(); j++)
      {
         const bool presses = (*factors.gap_weights)[j] > 0.0;
         squares += presses ? std::pow(area[j] * rows[j], 2) : 0.0;
      }
   }
   return std::sqrt(SumOverRanks(squares, comm));
}
} // namespace

ToleranceRule::ToleranceRule(BiphasicSpaces &spaces_,
                             BoundaryConditions &conditions_,
                             const std::vector<ContactPair *> &pairs_,
                             const std::vector<TiedInterface *> &interfaces_,
                             const StageEquations &equations_, real_t relative_)
   : spaces(spaces_), conditions(conditions_), pairs(pairs_),
     interfaces(interfaces_), equations(equations_), relative(relative_)
{
}

ResidualTolerance ToleranceRule::Find(const ImplicitStage &stage,
                                      real_t force_per_volume) const
{
   // How much of one equation's change counts as change of the other, which may
   // have none of its own.
   constexpr real_t coupled = 1e-2;
   // How much stricter Tighten() may be: loads and stiff contact may make much
   // of what is hardly any fluid.
   constexpr real_t strictest = 1e-5;
   MPI_Comm comm = spaces.GetComm();
   const auto norm = [comm](const Vector &x)
   { return std::sqrt(InnerProduct(comm, x, x)); };

   ImplicitStage still(stage);
   still.from_start = true;
   still.u = stage.u0;
   still.p = stage.p0;
   conditions.SetDisplacement(stage.time, still.u);
   conditions.SetPressure(stage.time, still.p);
   const RigidTies &ties = equations.Ties();
   still.poses = ties.Fit(still.u, stage.poses);
   ties.Prescribe(stage.time, still.poses);
   ties.Write(still.poses, still.u);
   BlockVector residual(spaces.Offsets());
   // Penalties of what a first guess tears apart are no measure.
   for (TiedInterface *tie : interfaces)
   {
      tie->UpdateTractions(ContactStiffness::none);
   }
   equations.ComputeResidual(still, residual);
   for (TiedInterface *tie : interfaces)
   {
      tie->UpdateTractions();
   }
   Vector moved(still.u);
   moved -= stage.u0;
   const real_t own_force = norm(residual.GetBlock(0));
   const real_t own_volume =
      std::max(norm(residual.GetBlock(1)), SweptVolume(pairs, moved, comm));
   const real_t force =
      std::max(own_force, coupled * force_per_volume * own_volume);
   const real_t volume =
      std::max(own_volume, coupled * own_force / force_per_volume);

   const RoundOff round_off = FindRoundOff(stage);
   const real_t most = relative * volume;
   ResidualTolerance tolerance;
   tolerance.momentum = std::max(relative * force, round_off.momentum);
   tolerance.mass = std::max(most, round_off.mass);
   tolerance.least_mass = std::max(strictest * most, round_off.mass);
   // A body at rest without loads has nothing to be relative to.
   constexpr real_t tiny = std::numeric_limits<real_t>::min();
   tolerance.momentum = std::max(tolerance.momentum, tiny);
   tolerance.mass = std::max(tolerance.mass, tiny);
   tolerance.least_mass = std::max(tolerance.least_mass, tiny);
   tolerance.untightened_mass = tolerance.mass;
   return tolerance;
}

ToleranceRule::RoundOff
ToleranceRule::FindRoundOff(const ImplicitStage &stage) const
{
   constexpr real_t of_sums = 1e-15;
   Vector momentum(stage.u.Size());
   Vector mass(stage.p.Size());
   // Magnitudes of the terms that cancel.
   Vector u(stage.u);
   Vector p(stage.p);
   u.Abs();
   p.Abs();
   momentum = 0.0;
   mass = 0.0;
   for (const ContactPair *pair : pairs)
   {
      pair->AddMagnitudes(u, p, momentum, mass);
   }
   for (const TiedInterface *tie : interfaces)
   {
      tie->AddMagnitudes(u, p, momentum, mass);
   }
   mass *= stage.dt;
   equations.Bodies().AddMagnitudes(stage.dt, u, p, momentum, mass);
   MPI_Comm comm = spaces.GetComm();
   return {of_sums * std::sqrt(InnerProduct(comm, momentum, momentum)),
           of_sums * std::sqrt(InnerProduct(comm, mass, mass))};
}

void ToleranceRule::AllowRoundOff(const ImplicitStage &stage,
                                  ResidualTolerance &tolerance) const
{
   const RoundOff round_off = FindRoundOff(stage);
   tolerance.momentum = std::max(tolerance.momentum, round_off.momentum);
   tolerance.mass = std::max(tolerance.mass, round_off.mass);
   tolerance.least_mass = std::max(tolerance.least_mass, round_off.mass);
}

real_t ToleranceRule::Exchanged(const Vector &mass) const
{
   real_t squares = 0.0;
   for (const int dof : equations.DrainedDofs())
   {
      squares += mass[dof] * mass[dof];
   }
   return std::sqrt(SumOverRanks(squares, spaces.GetComm()));
}

bool ToleranceRule::KnowsExchange(const Vector &mass,
                                  const Vector &residual) const
{
   constexpr real_t known = 0.1;
   const real_t error =
      std::sqrt(InnerProduct(spaces.GetComm(), residual, residual));
   return error < known * Exchanged(mass);
}

bool ToleranceRule::Tighten(const Vector &mass,
                            ResidualTolerance &tolerance) const
{
   // Part of the fluid exchanged in the step that may get lost; Newton's method
   // of deforming bodies gains many digits at once.
   const real_t lost = equations.Bodies().IsLinear() ? 1e-7 : 1e-9;
   const real_t wanted = std::max(lost * Exchanged(mass), tolerance.least_mass);
   if (wanted >= 0.5 * tolerance.mass)
   {
      return false;
   }
   tolerance.mass = wanted;
   return true;
}

} // namespace synovia
