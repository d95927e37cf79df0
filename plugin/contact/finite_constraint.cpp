#include "synovia/contact/finite_constraint.hpp"
#include "synovia/general/reduce.hpp"

#include <algorithm>
#include <cmath>

namespace synovia
{

using namespace mfem;

FiniteConstraint::FiniteConstraint(ContactGeometry &geometry_,
                                   InitialOverlap initial_overlap_,
                                   real_t gap_tolerance_,
                                   const ContactTuning &tuning_)
   : geometry(geometry_), initial_overlap(initial_overlap_),
     gap_tolerance(gap_tolerance_), tuning(tuning_), gaps(MakeGap()),
     removed_overlap(geometry.DestinationAreas().Size())
{
   removed_overlap = 0.0;
}

void FiniteConstraint::SearchReference()
{
   if (displacement.Size() > 0)
   {
      return;
   }
   Vector undeformed(geometry.Source().Spaces().Displacement().GetTrueVSize());
   undeformed = 0.0;
   SearchAt(undeformed);
   const Vector overlap = geometry.FindOverlap(Coverage(), gaps->Gap());
   if (initial_overlap == InitialOverlap::remove)
   {
      removed_overlap = overlap;
   }
}

bool FiniteConstraint::AreSame(const Vector &u, const Vector &v) const
{
   u.HostRead();
   const bool same =
      u.Size() == v.Size() && std::equal(u.begin(), u.end(), v.begin());
   return !AnyRank(!same, geometry.Destination().Spaces().GetComm());
}

void FiniteConstraint::SearchAt(const Vector &u)
{
   if (!searched_anew || !AreSame(u, displacement))
   {
      geometry.SetDisplacement(u);
      displacement = u;
      searched_anew = SearchAnew();
   }
   gaps = std::move(searched_anew);
   linearized = false;
}

std::unique_ptr<FiniteGap> FiniteConstraint::MakeGap() const
{
   return std::make_unique<FiniteGap>(geometry.Source(), geometry.Destination(),
                                      geometry.DestinationAreas(),
                                      geometry.Options());
}

std::unique_ptr<FiniteGap> FiniteConstraint::SearchAnew() const
{
   std::unique_ptr<FiniteGap> found = MakeGap();
   found->Search(bearing);
   geometry.LeaveOutSlivers(found->Operators());
   return found;
}

std::unique_ptr<FiniteGap> FiniteConstraint::FindGap(const Vector &u)
{
   geometry.SetDisplacement(u);
   displacement = u;
   searched_anew.reset();
   return SearchAnew();
}

bool FiniteConstraint::HasDrifted()
{
   keeps = keeps && gaps->Pairing().Slid() < tuning.kept_slide;
   if (keeps)
   {
      return false;
   }
   if (!gaps->Pairing().HasDrifted())
   {
      return false;
   }
   searched_anew = SearchAnew();
   return AnyRank(Differs(*searched_anew),
                  geometry.Destination().Spaces().GetComm());
}

bool FiniteConstraint::Differs(const FiniteGap &other) const
{
   // What is far from touching has no say.
   const GapOperators &now = gaps->Operators();
   const GapOperators &then = other.Operators();
   const auto is_near = [](const FiniteGap &at, int j)
   {
      return at.Operators().area[j] > 0.0 &&
             at.Gap()[j] <= at.Operators().GrazingGap(j);
   };
   for (int j = 0; j < now.area.Size(); j++)
   {
      if (!is_near(*gaps, j) && !is_near(other, j))
      {
         continue;
      }
      const real_t gap = gaps->Gap()[j];
      const real_t gap_change = std::abs(other.Gap()[j] - gap);
      const real_t area_change = std::abs(then.area[j] - now.area[j]);
      if (gap_change > tuning.drift_of_tolerance * gap_tolerance +
                          tuning.drift_of_gap * std::abs(gap) ||
          area_change > tuning.drift_of_area * now.area[j])
      {
         return true;
      }
   }
   return false;
}

void FiniteConstraint::StartStep(const Vector &u, bool failed)
{
   SearchReference();
   at_start.reset();
   keeps = tuning.kept_slide > 0.0 && !failed && kept_at.Size() > 0;
   if (keeps)
   {
      TakeKept(u);
   }
   else
   {
      std::unique_ptr<FiniteGap> searched = FindBearing(u);
      if (tuning.kept_slide > 0.0)
      {
         at_start = std::move(searched);
      }
   }
}

void FiniteConstraint::TakeKept(const Vector &u)
{
   // What is left of it is for the step that begins.
   constexpr real_t most = 0.5;
   FindKept(kept_at, u);
   if (gaps->Pairing().Slid() >= most * tuning.kept_slide)
   {
      kept_at = u;
      FindKept(kept_at, u);
   }
}

void FiniteConstraint::FindKept(const Vector &at, const Vector &u)
{
   FindBearing(at);
   SearchAt(at);
   Follow(u);
}

std::unique_ptr<FiniteGap> FiniteConstraint::FindBearing(const Vector &u)
{
   bearing = KeptBearing();
   std::unique_ptr<FiniteGap> searched = FindGap(u);
   bearing = searched->FindBearing(tuning.bearing_angle);
   return searched;
}

void FiniteConstraint::Accept()
{
   if (keeps)
   {
      return;
   }
   kept_at.SetSize(0);
   if (at_start)
   {
      at_start->Follow();
      if (at_start->Pairing().Slid() < tuning.kept_slide)
      {
         kept_at = displacement;
      }
   }
}

bool FiniteConstraint::Search(const Vector &u)
{
   if (keeps)
   {
      return true;
   }
   if (!reached)
   {
      SearchReference();
      geometry.VerifyReach(Coverage());
      reached = true;
   }
   SearchAt(u);
   return true;
}

void FiniteConstraint::Follow(const Vector &u)
{
   geometry.SetDisplacement(u);
   displacement = u;
   searched_anew.reset();
   gaps->Follow();
   geometry.LeaveOutSlivers(gaps->Operators());
}

void FiniteConstraint::Evaluate(const Vector &u, const Vector &p, Vector &gap,
                                Vector &jump, Vector &pressure)
{
   if (!AreSame(u, displacement))
   {
      Follow(u);
   }
   const GapOperators &operators = gaps->Operators();
   gap = gaps->Gap();
   for (int j = 0; j < gap.Size(); j++)
   {
      gap[j] += operators.area[j] > 0.0 ? removed_overlap[j] : 0.0;
   }
   MultJump(*operators.jump, geometry.Destination(), p, jump, pressure);
}

void FiniteConstraint::StartLinearize(const Vector &p,
                                      const Vector &nodal_force,
                                      const Vector &nodal_flow)
{
   gaps->Derivatives().Start(p, nodal_force, nodal_flow);
}

void FiniteConstraint::IntegrateDerivatives()
{
   gaps->Derivatives().Integrate();
}

bool FiniteConstraint::FinishLinearize()
{
   gaps->Derivatives().Assemble();
   linearized = true;
   return true;
}

ContactFactors FiniteConstraint::Factors() const
{
   ContactFactors factors;
   factors.gap = factors.gap_change = gaps->Operators().gap.get();
   factors.jump = gaps->Operators().jump.get();
   if (linearized)
   {
      const GapDerivatives &derivatives = gaps->Derivatives();
      factors.gap_change = &derivatives.Gap();
      factors.jump_change = &derivatives.Jump();
      factors.force_change = &derivatives.Force();
      factors.outflow_change = &derivatives.Outflow();
   }
   return factors;
}

void FiniteConstraint::Archive(StateArchive &archive, const std::string &prefix)
{
   archive.Flag(prefix + "reached", reached);
   geometry.Destination().Archive(archive, prefix + "removed_overlap",
                                  removed_overlap);
   bool has_kept = kept_at.Size() > 0;
   archive.Flag(prefix + "keeps", has_kept);
   if (!has_kept)
   {
      kept_at.SetSize(0);
      return;
   }
   ParFiniteElementSpace &space =
      geometry.Destination().Spaces().Displacement();
   kept_at.SetSize(space.GetTrueVSize());
   archive.Field(prefix + "kept_at", space, kept_at);
}

} // namespace synovia
