#include "synovia/contact/finite_constraint.hpp"
#include "synovia/general/reduce.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

namespace
{
bool SameOnAllRanks(const Vector &a, const Vector &b, MPI_Comm comm)
{
   a.HostRead();
   b.HostRead();
   const bool same =
      a.Size() == b.Size() && std::equal(a.begin(), a.end(), b.begin());
   return !AnyRank(!same, comm);
}
} // namespace

FiniteConstraint::FiniteConstraint(ContactGeometry &geometry_,
                                   InitialOverlap initial_overlap_)
   : geometry(geometry_), initial_overlap(initial_overlap_),
     gaps(geometry.Source(), geometry.Destination(), geometry.Options()),
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
   const Vector overlap = geometry.FindOverlap(Coverage(), gaps.Gap());
   if (initial_overlap == InitialOverlap::remove)
   {
      removed_overlap = overlap;
   }
}

void FiniteConstraint::SearchAt(const Vector &u)
{
   geometry.SetDisplacement(u);
   displacement = u;
   gaps.Search();
   geometry.LeaveOutSlivers(gaps.Operators());
   linearized = false;
}

bool FiniteConstraint::Search(const Vector &u)
{
   if (!reached)
   {
      SearchReference();
      geometry.VerifyReach(Coverage());
      reached = true;
   }
   SearchAt(u);
   return true;
}

void FiniteConstraint::Evaluate(const Vector &u, const Vector &p, Vector &gap,
                                Vector &jump, Vector &pressure)
{
   if (!SameOnAllRanks(u, displacement,
                       geometry.Destination().Spaces().GetComm()))
   {
      geometry.SetDisplacement(u);
      displacement = u;
      gaps.Follow();
      geometry.LeaveOutSlivers(gaps.Operators());
      linearized = false;
   }
   const GapOperators &operators = gaps.Operators();
   gap = gaps.Gap();
   for (int j = 0; j < gap.Size(); j++)
   {
      gap[j] += operators.area[j] > 0.0 ? removed_overlap[j] : 0.0;
   }
   MultJump(*operators.jump, geometry.Destination(), p, jump, pressure);
}

bool FiniteConstraint::Linearize(const Vector &p, const Vector &nodal_force,
                                 const Vector &nodal_flow)
{
   gaps.Linearize(p, nodal_force, nodal_flow);
   linearized = true;
   return true;
}

ContactFactors FiniteConstraint::Factors() const
{
   ContactFactors factors;
   factors.gap = factors.gap_change = gaps.Operators().gap.get();
   factors.jump = gaps.Operators().jump.get();
   if (linearized)
   {
      factors.gap_change = &gaps.GapChange();
      factors.jump_change = &gaps.JumpChange();
      factors.force_change = &gaps.ForceChange();
      factors.outflow_change = &gaps.OutflowChange();
   }
   return factors;
}

void FiniteConstraint::Archive(StateArchive &archive, const std::string &prefix)
{
   archive.Flag(prefix + "reached", reached);
   geometry.Destination().Archive(archive, prefix + "removed_overlap",
                                  removed_overlap);
}

} // namespace synovia
