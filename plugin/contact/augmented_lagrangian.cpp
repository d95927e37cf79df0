#include "synovia/contact/augmented_lagrangian.hpp"
#include "synovia/contact/contact_friction.hpp"
#include "synovia/contact/frictionless_law.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/general/reduce_lists.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace synovia
{

using namespace mfem;

namespace
{
// @a bodies is what the bodies on both sides resist.
real_t Stiffness(ContactStiffness stiffness, real_t penalty, real_t bodies)
{
   switch (stiffness)
   {
   case ContactStiffness::none:
      return 0.0;
   case ContactStiffness::bodies:
      return std::min(penalty, bodies);
   default:
      return penalty;
   }
}
} // namespace

AugmentedLagrangian::AugmentedLagrangian(ContactConstraint &constraint_,
                                         const ContactSurface &destination_,
                                         const Vector &vertex_areas_,
                                         const ContactScales &scales,
                                         const ContactOptions &options_,
                                         const ContactTuning &tuning_)
   : constraint(constraint_), destination(destination_),
     vertex_areas(vertex_areas_), options(options_), tuning(tuning_),
     gap_tolerance(scales.gap_tolerance), fluid(scales.fluid),
     pressure_held(vertex_areas.Size()),
     penalties(options, scales, vertex_areas), state(vertex_areas.Size()),
     accepted(state)
{
   pressure_held = false;
}

AugmentedLagrangian::~AugmentedLagrangian() = default;

void AugmentedLagrangian::AddFriction(
   std::unique_ptr<ContactFriction> friction_)
{
   friction = std::move(friction_);
   state = ContactState(vertex_areas.Size(), true);
   accepted = state;
}

void AugmentedLagrangian::SetHeldPressures(const Array<int> &vertices)
{
   const Array<int> &own = destination.Vertices().TrueDofs();
   for (int j = 0; j < own.Size(); j++)
   {
      pressure_held[j] = vertices.FindSorted(own[j]) >= 0;
   }
}

void AugmentedLagrangian::SetTimeStep(real_t dt)
{
   if (penalties.SetTimeStep(dt))
   {
      UpdatePenalties();
   }
}

void AugmentedLagrangian::UpdatePenalties()
{
   const ContactCoverage &coverage = constraint.Coverage();
   if (coverage.area.Size() == vertex_areas.Size())
   {
      penalties.Update(coverage, state.stiffening);
   }
}

void AugmentedLagrangian::StartStage(real_t time)
{
   constexpr real_t infinite = std::numeric_limits<real_t>::infinity();
   last = {infinite, infinite, infinite};
   for (VertexContact &vertex : state.vertices)
   {
      vertex.seal_broke = false;
   }
   if (friction)
   {
      friction->StartStage(state.friction);
   }
   phase = Phase::prediction;
   state.history.Predict(time, tuning.prediction_reach, state.multiplier,
                         state.flux_multiplier);
}

void AugmentedLagrangian::Evaluate(const Vector &u, const Vector &p)
{
   constraint.Evaluate(u, p, state.gap, state.jump, state.pressure);
   if (friction)
   {
      friction->Evaluate(u, p, state.friction);
   }
   if (fluid == FluidSides::source)
   {
      // Less that of the destination, which is zero.
      state.pressure = state.jump;
   }
}

real_t AugmentedLagrangian::TouchingGap() const
{
   const ContactCoverage &coverage = constraint.Coverage();
   real_t nearest = std::numeric_limits<real_t>::infinity();
   for (int j = 0; j < state.gap.Size(); j++)
   {
      if (coverage.area[j] > 0.0 && state.gap[j] < coverage.GrazingGap(j))
      {
         nearest = std::min(nearest, state.gap[j]);
      }
   }
   nearest = -MaxOverRanks(-nearest, destination.Spaces().GetComm());
   return std::isfinite(nearest) ? std::max(gap_tolerance, nearest)
                                 : gap_tolerance;
}

real_t AugmentedLagrangian::GapStiffness(int vertex,
                                         ContactStiffness stiffness) const
{
   return Stiffness(stiffness, penalties.Gap()[vertex],
                    penalties.Resistance()[vertex]);
}

real_t AugmentedLagrangian::JumpStiffness(int vertex,
                                          ContactStiffness stiffness) const
{
   return Stiffness(stiffness, penalties.Jump()[vertex],
                    penalties.Conductance()[vertex]);
}

Vector AugmentedLagrangian::GapStiffnesses(ContactStiffness stiffness) const
{
   Vector all(state.gap.Size());
   for (int j = 0; j < all.Size(); j++)
   {
      all[j] = GapStiffness(j, stiffness);
   }
   return all;
}

Vector AugmentedLagrangian::TrialTractions(ContactStiffness stiffness) const
{
   Vector all(state.gap.Size());
   for (int j = 0; j < all.Size(); j++)
   {
      all[j] = FrictionlessLaw::Traction(
         state.multiplier[j], GapStiffness(j, stiffness), state.gap[j]);
   }
   return all;
}

bool AugmentedLagrangian::UpdateActiveSet(TouchRule rule,
                                          ContactStiffness stiffness,
                                          real_t imbalance)
{
   const Vector &area = constraint.Coverage().area;
   const Vector &own_area = constraint.Coverage().own_area;
   // A predicted gap is off by more than what penetrates.
   const ContactStiffness trial_stiffness =
      phase == Phase::prediction ? ContactStiffness::bodies : stiffness;
   const real_t touching = rule == TouchRule::nearness
                              ? TouchingGap()
                              : -std::numeric_limits<real_t>::infinity();
   bool changed = false;
   const std::vector<VertexContact> all_before(
      friction ? state.vertices : std::vector<VertexContact>());
   for (int j = 0; j < area.Size(); j++)
   {
      const VertexContact before = state.vertices[j];
      VertexContact &vertex = state.vertices[j];
      const real_t trial = FrictionlessLaw::Traction(
         state.multiplier[j], GapStiffness(j, trial_stiffness), state.gap[j]);
      vertex.touches =
         area[j] > 0.0 &&
         (FrictionlessLaw::Bears(trial) || state.gap[j] <= touching ||
          (phase == Phase::augmentation && before.touches));
      vertex.seals = area[j] > 0.0 &&
                     own_area[j] > tuning.sealing_coverage * vertex_areas[j] &&
                     (vertex.touches || state.gap[j] < gap_tolerance ||
                      (before.seals && before.seal_broke));
      vertex.seal_broke = before.seal_broke || (before.seals && !vertex.seals);
      changed = changed || vertex.touches != before.touches ||
                vertex.seals != before.seals;
      state.gap_weights[j] =
         vertex.touches ? area[j] * penalties.Gap()[j] : 0.0;
      state.jump_weights[j] =
         Exchanges(j) ? area[j] * penalties.Jump()[j] : 0.0;
   }
   if (friction && phase == Phase::prediction)
   {
      friction->PredictSliding(TrialTractions(trial_stiffness), all_before,
                               GapStiffnesses(trial_stiffness), state);
   }
   else if (friction)
   {
      changed =
         friction->UpdateSliding(TrialTractions(trial_stiffness), all_before,
                                 GapStiffnesses(trial_stiffness),
                                 penalties.Gap(), imbalance, state) ||
         changed;
   }
   if (friction)
   {
      friction->LagLimits(TrialTractions(ContactStiffness::bodies),
                          TrialTractions(ContactStiffness::penalty), state);
   }
   phase = Phase::iteration;
   UpdateTractions();
   return AnyRank(changed, destination.Spaces().GetComm());
}

bool AugmentedLagrangian::SlidingChanged() const
{
   return friction && friction->SlidingChanged();
}

void AugmentedLagrangian::UpdateTractions(ContactStiffness stiffness)
{
   for (int j = 0; j < state.gap.Size(); j++)
   {
      state.traction[j] =
         state.vertices[j].touches
            ? FrictionlessLaw::Traction(
                 state.multiplier[j], GapStiffness(j, stiffness), state.gap[j])
            : 0.0;
      state.flux[j] =
         Exchanges(j)
            ? FrictionlessLaw::Flux(state.flux_multiplier[j],
                                    JumpStiffness(j, stiffness), state.jump[j])
            : 0.0;
   }
   if (friction)
   {
      friction->UpdateTractions(GapStiffnesses(stiffness), penalties.Gap(),
                                state);
   }
}

MultiplierStep
AugmentedLagrangian::FindMultiplierStep(const Vector &gap_change,
                                        const Vector &jump_change) const
{
   MultiplierStep step{Vector(state.gap.Size()), Vector(state.gap.Size()), {}};
   for (int j = 0; j < state.gap.Size(); j++)
   {
      step.traction[j] =
         state.vertices[j].touches
            ? penalties.Gap()[j] * (state.gap[j] + gap_change[j])
            : -state.multiplier[j];
      step.flux[j] = Exchanges(j)
                        ? penalties.Jump()[j] * (state.jump[j] + jump_change[j])
                        : -state.flux_multiplier[j];
   }
   return step;
}

void AugmentedLagrangian::AddSolved(const Vector &forces,
                                    const Vector &outflows,
                                    MultiplierStep &step) const
{
   const Vector &area = constraint.Coverage().area;
   for (int j = 0; j < area.Size(); j++)
   {
      if (state.vertices[j].touches)
      {
         step.traction[j] += forces[j] / area[j];
      }
      if (Exchanges(j))
      {
         step.flux[j] += outflows[j] / area[j];
      }
   }
}

VectorByComponent AugmentedLagrangian::FindFrictionStep(const Vector &du,
                                                        const Vector &dp) const
{
   return friction ? friction->FindMultiplierStep(
                        du, dp, TrialTractions(ContactStiffness::penalty),
                        penalties.Gap(), state)
                   : VectorByComponent();
}

void AugmentedLagrangian::AddToMultipliers(real_t share,
                                           const MultiplierStep &step)
{
   state.multiplier.Add(share, step.traction);
   state.flux_multiplier.Add(share, step.flux);
   for (int c = 0; c < 3 && friction; c++)
   {
      state.friction.multiplier[c].Add(share, step.friction[c]);
   }
}

ContactViolations AugmentedLagrangian::FindViolations() const
{
   std::vector<real_t> worst(3, 0.0);
   for (int j = 0; j < state.gap.Size(); j++)
   {
      if (state.vertices[j].touches)
      {
         worst[0] = std::max(worst[0], std::abs(state.gap[j]));
      }
      if (Exchanges(j))
      {
         worst[1] = std::max(worst[1], std::abs(state.jump[j]));
      }
   }
   if (friction)
   {
      worst[2] = friction->FindViolation(
         TrialTractions(ContactStiffness::penalty), penalties.Gap(), state);
   }
   MaxOverRanks(worst, destination.Spaces().GetComm());
   return {worst[0], worst[1], worst[2]};
}

bool AugmentedLagrangian::IsWithinTolerance(const ContactViolations &violations,
                                            real_t peak_pressure) const
{
   return violations.penetration <= gap_tolerance &&
          violations.slip <= gap_tolerance &&
          violations.pressure_jump <=
             options.pressure_tolerance * peak_pressure;
}

void AugmentedLagrangian::Augment()
{
   TakeMultipliers();
   phase = Phase::augmentation;
}

void AugmentedLagrangian::TakeMultipliers()
{
   state.multiplier = state.traction;
   state.flux_multiplier = state.flux;
}

bool AugmentedLagrangian::StiffenIfSlow(const ContactViolations &violations,
                                        real_t peak_pressure)
{
   bool raised = false;
   const auto check =
      [&](real_t value, real_t tolerance, real_t &last_value, real_t &factor)
   {
      if (value > tolerance && value > tuning.slow_augmentation * last_value &&
          factor < tuning.largest_stiffening)
      {
         factor *= tuning.stiffening_factor;
         raised = true;
      }
      last_value = value;
   };
   check(violations.penetration, gap_tolerance, last.penetration,
         state.stiffening.gap);
   check(violations.pressure_jump, options.pressure_tolerance * peak_pressure,
         last.pressure_jump, state.stiffening.jump);
   if (raised)
   {
      UpdatePenalties();
   }
   return raised;
}

void AugmentedLagrangian::Store(real_t time)
{
   TakeMultipliers();
   if (friction)
   {
      friction->TakeMultipliers(state.friction);
   }
   state.history.Store(time, state.multiplier, state.flux_multiplier);
}

void AugmentedLagrangian::Accept()
{
   state.touched =
      state.touched || std::any_of(state.traction.begin(), state.traction.end(),
                                   FrictionlessLaw::Bears);
   if (friction)
   {
      friction->Accept(state);
   }
   constraint.Accept();
   accepted = state;
}

void AugmentedLagrangian::Restore()
{
   state = accepted;
   UpdatePenalties();
}

void AugmentedLagrangian::Archive(StateArchive &archive,
                                  const std::string &prefix)
{
   accepted.Archive(archive, prefix, destination);
   if (friction)
   {
      friction->Archive(archive, prefix + "friction.");
   }
   if (archive.Reads())
   {
      Restore();
   }
}

} // namespace synovia
