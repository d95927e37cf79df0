#include "synovia/physics/stage_contact.hpp"
#include "synovia/general/phase_timer.hpp"
#include "synovia/general/reduce.hpp"

#include <algorithm>
#include <cmath>

namespace synovia
{

using namespace mfem;

StageContact::StageContact(MPI_Comm comm_,
                           const std::vector<ContactPair *> &pairs_,
                           const std::vector<TiedInterface *> &interfaces_,
                           const std::vector<PushedBodies> &pushed_,
                           StageEquations &equations_,
                           BiphasicLinearSolver &linear_, SolveRecord &record_)
   : comm(comm_), pairs(pairs_), interfaces(interfaces_), pushed(pushed_),
     equations(equations_), linear(linear_), record(record_)
{
}

void StageContact::Start(ImplicitStage &stage, TouchRule rule)
{
   Search(stage);
   for (ContactPair *pair : pairs)
   {
      pair->Enforcement().StartStage(stage.time);
      pair->Enforcement().Evaluate(stage.u, stage.p);
   }
   if (!equations.Bodies().IsLinear() && stage.is_expected && Overlaps())
   {
      stage.BeginAnew();
      Search(stage);
      for (ContactPair *pair : pairs)
      {
         pair->Enforcement().Evaluate(stage.u, stage.p);
      }
   }
   for (ContactPair *pair : pairs)
   {
      pair->Enforcement().UpdateActiveSet(rule);
   }
   for (TiedInterface *tie : interfaces)
   {
      tie->StartStage(stage.time);
   }
   CatchPushed(stage);
   equations.UpdateDrainedDofs(stage);
}

bool StageContact::Overlaps() const
{
   // In grazing gaps. Without the guess for single vertices that overlap a
   // little, a step would take twice as many iterations.
   constexpr real_t deep = 4.0;
   bool any = false;
   for (const ContactPair *pair : pairs)
   {
      const ContactCoverage &coverage = pair->Constraint().Coverage();
      for (int j = 0; j < coverage.area.Size(); j++)
      {
         any = any || (coverage.area[j] > 0.0 &&
                       pair->State().gap[j] < -deep * coverage.GrazingGap(j));
      }
   }
   return AnyRank(any, comm);
}

real_t StageContact::ShareBeforeOverlap(const Vector &displacement) const
{
   // Where a ray grazes the source, its hit moves much farther than surfaces
   // do.
   const real_t farthest =
      2.0 * MaxOverRanks(
               displacement.Size() > 0 ? displacement.Normlinf() : 0.0, comm);
   real_t share = 1.0;
   for (const ContactPair *pair : pairs)
   {
      const ContactCoverage &coverage = pair->Constraint().Coverage();
      Vector closing(coverage.area.Size());
      pair->Factors().gap_change->Mult(-1.0, displacement, 0.0, closing);
      closing.HostRead();
      for (int j = 0; j < closing.Size(); j++)
      {
         const real_t room =
            std::max(pair->State().gap[j], 0.0) + coverage.GrazingGap(j);
         const real_t closes = std::min(closing[j], farthest);
         if (coverage.area[j] > 0.0 && closes > room)
         {
            share = std::min(share, room / closes);
         }
      }
   }
   return -MaxOverRanks(-share, comm);
}

void StageContact::Search(const ImplicitStage &stage)
{
   const PhaseTimer timer(record.times.search, "search");
   if (equations.SearchContact(stage))
   {
      linear.ContactMoved();
      record.report.searches++;
      record.work.searches++;
   }
}

void StageContact::Remember()
{
   for (ContactPair *pair : pairs)
   {
      pair->Remember();
   }
}

void StageContact::GoBack()
{
   for (ContactPair *pair : pairs)
   {
      pair->GoBack();
   }
}

bool StageContact::SearchDrifted(ImplicitStage &stage,
                                 ContactStiffness stiffness, bool settled)
{
   bool drifted = false;
   for (ContactPair *pair : pairs)
   {
      // Where points were made may not depend on iterates that are far from a
      // solution.
      const bool looks = settled || !pair->KeepsFound();
      drifted = (looks && pair->HasDrifted()) || drifted;
   }
   if (drifted)
   {
      Search(stage);
      equations.EvaluateContact(stage);
      Update(stage, stiffness);
      equations.UpdateDrainedDofs(stage);
   }
   return drifted;
}

bool StageContact::Update(ImplicitStage &stage, ContactStiffness stiffness,
                          real_t imbalance)
{
   bool changed = false;
   unsettled.clear();
   for (ContactPair *pair : pairs)
   {
      if (pair->Enforcement().UpdateActiveSet(TouchRule::traction, stiffness,
                                              imbalance))
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

bool StageContact::CatchPushed(ImplicitStage &stage)
{
   bool caught = false;
   for (const PushedBodies &group : pushed)
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
      stage.poses = equations.Ties().Fit(stage.u, stage.poses);
      for (ContactPair *pair : pairs)
      {
         pair->Enforcement().Evaluate(stage.u, stage.p);
         pair->Enforcement().UpdateActiveSet(TouchRule::nearness);
      }
      caught = true;
   }
   return caught;
}

bool StageContact::SlidingChanged() const
{
   return std::any_of(pairs.begin(), pairs.end(),
                      [](const ContactPair *pair)
                      { return pair->Enforcement().SlidingChanged(); });
}

bool StageContact::HasFriction() const
{
   return std::any_of(pairs.begin(), pairs.end(),
                      [](const ContactPair *pair)
                      { return pair->State().rubs; });
}

StageContact::Violations
StageContact::FindViolations(const ImplicitStage &stage) const
{
   Violations violations;
   violations.peak_pressure =
      MaxOverRanks(stage.p.Size() > 0 ? stage.p.Normlinf() : 0.0, comm);
   for (const ContactPair *pair : pairs)
   {
      const AugmentedLagrangian &enforcement = pair->Enforcement();
      violations.pairs.push_back(enforcement.FindViolations());
      violations.within_tolerance =
         enforcement.IsWithinTolerance(violations.pairs.back(),
                                       violations.peak_pressure) &&
         violations.within_tolerance;
   }
   for (const TiedInterface *tie : interfaces)
   {
      violations.interfaces.push_back(tie->FindViolations());
      violations.within_tolerance =
         tie->IsWithinTolerance(violations.interfaces.back(),
                                violations.peak_pressure) &&
         violations.within_tolerance;
   }
   return violations;
}

bool StageContact::Augment(const Violations &violations)
{
   for (ContactPair *pair : pairs)
   {
      pair->Enforcement().Augment();
   }
   for (TiedInterface *tie : interfaces)
   {
      tie->Augment();
   }
   const bool stiffened = StiffenIfSlow(violations);
   for (TiedInterface *tie : interfaces)
   {
      tie->UpdateTractions();
   }
   return stiffened;
}

bool StageContact::StiffenIfSlow(const Violations &violations)
{
   bool stiffened = false;
   for (std::size_t i = 0; i < pairs.size(); i++)
   {
      stiffened = pairs[i]->Enforcement().StiffenIfSlow(
                     violations.pairs[i], violations.peak_pressure) ||
                  stiffened;
   }
   for (std::size_t i = 0; i < interfaces.size(); i++)
   {
      stiffened = interfaces[i]->StiffenIfSlow(violations.interfaces[i],
                                               violations.peak_pressure) ||
                  stiffened;
   }
   return stiffened;
}

bool StageContact::FailIterations(int iterations)
{
   const std::string count = std::to_string(iterations) + " iterations";
   return record.report.Fail(
      unsettled.empty() ? "Newton's method did not converge in " + count
                        : "the contact's active set did not settle in " +
                             count + ": " + unsettled);
}

void StageContact::SetTractions(ContactStiffness stiffness)
{
   for (ContactPair *pair : pairs)
   {
      pair->Enforcement().UpdateTractions(stiffness);
   }
   for (TiedInterface *tie : interfaces)
   {
      tie->UpdateTractions(stiffness);
   }
}

} // namespace synovia
