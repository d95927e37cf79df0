#include "synovia/physics/augmented_newton.hpp"
#include "synovia/general/text.hpp"

#include <algorithm>
#include <cmath>

namespace synovia
{

using namespace mfem;

bool AugmentedNewton::Solve(ImplicitStage &stage, ResidualTolerance &tolerance)
{
   for (int augmentation = 0;; augmentation++)
   {
      if (!SolveContact(stage, tolerance))
      {
         return false;
      }
      const StageContact::Violations violations = contact.FindViolations(stage);
      if (violations.within_tolerance)
      {
         return true;
      }
      if (augmentation == options.max_augmentations)
      {
         return FailAugmentations(violations);
      }
      Augment(stage, tolerance, violations);
   }
}

bool AugmentedNewton::SolveContact(ImplicitStage &stage,
                                   ResidualTolerance &tolerance)
{
   BlockVector imbalance(spaces.Offsets());
   BlockVector residual(spaces.Offsets());
   BlockVector step(spaces.Offsets());
   for (int iteration = 0; iteration < options.max_newton; iteration++)
   {
      equations.ComputeImbalance(stage, imbalance.GetBlock(0),
                                 imbalance.GetBlock(1));
      residual = imbalance;
      equations.MakeResidual(stage, residual);
      real_t norm = linear.Norm(residual, tolerance);
      if (norm <= 1.0 && stage.from_start)
      {
         stage.from_start = false;
         continue;
      }
      if (norm <= 1.0 && rule.Tighten(imbalance.GetBlock(1), tolerance))
      {
         norm = linear.Norm(residual, tolerance);
      }
      if (norm <= 1.0)
      {
         return true;
      }
      if (!std::isfinite(norm))
      {
         return record.report.Fail("the residual is not a finite number");
      }
      direction.Linearize(stage);
      if (!direction.Solve(residual, LinearTarget(norm), tolerance, step))
      {
         return false;
      }
      stage.from_start = false;
      equations.Add(1.0, step, stage);
      equations.EvaluateContact(stage);
      contact.Update(stage, ContactStiffness::penalty);
      rule.AllowRoundOff(stage, tolerance);
   }
   return contact.FailIterations(options.max_newton);
}

void AugmentedNewton::Augment(ImplicitStage &stage,
                              ResidualTolerance &tolerance,
                              const StageContact::Violations &violations)
{
   const bool stiffened = contact.Augment(violations);
   contact.Update(stage, ContactStiffness::penalty);
   if (stiffened)
   {
      // Larger penalties make more round-off.
      tolerance = rule.Find(stage, linear.ForcePerVolume());
   }
   record.report.augmentations++;
}

bool AugmentedNewton::FailAugmentations(
   const StageContact::Violations &violations)
{
   std::string left;
   for (std::size_t i = 0; i < contact.Pairs().size(); i++)
   {
      const ContactPair &pair = *contact.Pairs()[i];
      left += "; " + pair.Name() + ": gap " +
              ToText(violations.pairs[i].penetration) + " (tolerance " +
              ToText(pair.Scales().gap_tolerance) + "), pressure jump " +
              ToText(violations.pairs[i].pressure_jump) + " (peak pressure " +
              ToText(violations.peak_pressure) + ")";
   }
   for (std::size_t i = 0; i < contact.Interfaces().size(); i++)
   {
      const TiedInterface &tie = *contact.Interfaces()[i];
      left += "; tie " + tie.Name() + ": displacement jump " +
              ToText(violations.interfaces[i].displacement) + " (tolerance " +
              ToText(tie.Scales().displacement_tolerance) +
              "), pressure jump " + ToText(violations.interfaces[i].pressure) +
              " (peak pressure " + ToText(violations.peak_pressure) + ")";
   }
   return record.report.Fail("gap or pressure jump out of tolerance after " +
                             std::to_string(options.max_augmentations) +
                             " augmentations" + left);
}

real_t AugmentedNewton::LinearTarget(real_t norm) const
{
   // What decides the active set need not be exact; a settled set is solved to
   // the end.
   const real_t part =
      contact.Pairs().empty() ? 0.0 : options.active_set_tolerance;
   return std::max(1.0, part * norm);
}

} // namespace synovia
