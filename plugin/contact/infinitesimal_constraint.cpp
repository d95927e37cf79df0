#include "synovia/contact/infinitesimal_constraint.hpp"
#include "synovia/contact/contact_area.hpp"
#include "synovia/contact/friction_state.hpp"
#include "synovia/general/reduce_lists.hpp"

#include <algorithm>
#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
/// Of displacement @a u (true dofs), at the vertices of a surface.
Vector ComponentAtVertices(const ContactSurface &surface, const Vector &u,
                           int component)
{
   const Array<int> &dofs = surface.Vertices().TrueDofs();
   Vector values(dofs.Size());
   for (int j = 0; j < values.Size(); j++)
   {
      // Of the displacement's nodes, vertices are the first, in this order.
      values[j] = u[3 * dofs[j] + component];
   }
   return values;
}

/// Means over what the source covers around each vertex of the destination, of
/// how much farther than the destination the source goes with a displacement
/// @a u (true dofs).
VectorByComponent FindSlip(const ContactGeometry &geometry,
                           const ContactCoverage &coverage, const Vector &u)
{
   VectorByComponent slip;
   for (int c = 0; c < 3; c++)
   {
      const Vector source = ComponentAtVertices(geometry.Source(), u, c);
      const Vector destination =
         VertexMeans(geometry.Destination(), coverage.face_coverage,
                     ComponentAtVertices(geometry.Destination(), u, c));
      slip[c].SetSize(coverage.area.Size());
      coverage.coverage->MultTranspose(source, slip[c]);
      slip[c].HostReadWrite();
      for (int j = 0; j < slip[c].Size(); j++)
      {
         slip[c][j] = coverage.area[j] > 0.0
                         ? slip[c][j] / coverage.own_area[j] - destination[j]
                         : 0.0;
      }
   }
   return slip;
}

/// At displacement @a u; overlap of undeformed surfaces is not removed.
Vector FindGap(const GapOperators &operators, const Vector &u)
{
   Vector gap(operators.gap_offset);
   operators.gap->Mult(1.0, u, 1.0, gap);
   gap.HostReadWrite();
   return gap;
}
} // namespace

InfinitesimalConstraint::InfinitesimalConstraint(
   ContactGeometry &geometry_, SearchConfiguration configuration_,
   InitialOverlap initial_overlap_, real_t kept_slide_)
   : geometry(geometry_), configuration(configuration_),
     initial_overlap(initial_overlap_), kept_slide(kept_slide_),
     removed_overlap(geometry.DestinationAreas().Size())
{
   removed_overlap = 0.0;
}

void InfinitesimalConstraint::SearchReference()
{
   if (operators.gap)
   {
      return;
   }
   Take(geometry.Search());
   const Vector overlap = geometry.FindOverlap(operators, gap_offset);
   if (initial_overlap == InitialOverlap::remove)
   {
      removed_overlap = overlap;
   }
}

void InfinitesimalConstraint::SearchAt(const Vector &u)
{
   geometry.SetDisplacement(u);
   Take(geometry.Search());
   searched = false;
}

void InfinitesimalConstraint::Take(GapOperators found)
{
   operators = std::move(found);
   gap_offset = operators.gap_offset;
}

void InfinitesimalConstraint::StartStep(const Vector &, bool failed)
{
   if (failed)
   {
      searched_at.SetSize(0);
   }
}

bool InfinitesimalConstraint::Search(const Vector &u)
{
   if (!reached)
   {
      SearchReference();
      geometry.VerifyReach(operators);
      reached = true;
   }
   if (configuration == SearchConfiguration::current)
   {
      return SearchCurrent(u);
   }
   if (searched)
   {
      return false;
   }
   if (!operators.gap)
   {
      Take(geometry.Search());
   }
   searched = true;
   return true;
}

bool InfinitesimalConstraint::SearchCurrent(const Vector &u)
{
   // A run that goes on from another one keeps what that had found.
   const bool others = !searched;
   if (others && searched_at.Size() > 0)
   {
      SearchAt(searched_at);
   }
   geometry.SetDisplacement(u);
   GapOperators now = geometry.Search();
   searched = true;
   if (searched_at.Size() > 0)
   {
      const Vector gap = FindGap(now, u);
      if (Slid(now, gap, u) < kept_slide)
      {
         Follow(now, gap, u);
         // Forces are in balance where they were found.
         geometry.SetDisplacement(searched_at);
         return others;
      }
   }
   Take(std::move(now));
   if (kept_slide > 0.0)
   {
      searched_at = u;
   }
   return true;
}

real_t InfinitesimalConstraint::Slid(const GapOperators &now, const Vector &gap,
                                     const Vector &u) const
{
   Vector change(u);
   change -= searched_at;
   change.HostRead();
   const VectorByComponent slip = FindSlip(geometry, operators, change);
   // Of what touches, and of all.
   std::vector<real_t> farthest(2, -1.0);
   for (int j = 0; j < gap.Size(); j++)
   {
      if (!(operators.area[j] > 0.0))
      {
         continue;
      }
      const Point3 along = FrictionState::At(slip, j);
      const Point3 normal = FrictionState::At(operators.normal_area, j);
      const real_t share = Dot(along, normal) / Dot(normal, normal);
      const real_t size = std::sqrt(geometry.DestinationAreas()[j]);
      const real_t slid = Length(Sum(along, -share, normal)) / size;
      farthest[1] = std::max(farthest[1], slid);
      if (now.area[j] > 0.0 && gap[j] + removed_overlap[j] <= now.GrazingGap(j))
      {
         farthest[0] = std::max(farthest[0], slid);
      }
   }
   MaxOverRanks(farthest, geometry.Destination().Spaces().GetComm());
   if (farthest[1] < 0.0)
   {
      return infinity();
   }
   return farthest[0] < 0.0 ? farthest[1] : farthest[0];
}

void InfinitesimalConstraint::Follow(const GapOperators &now, const Vector &gap,
                                     const Vector &u)
{
   gap_offset = operators.gap_offset;
   const Vector kept = FindGap(operators, u);
   for (int j = 0; j < gap.Size(); j++)
   {
      if (operators.area[j] > 0.0 && now.area[j] > 0.0)
      {
         gap_offset[j] += gap[j] - kept[j];
      }
   }
}

void InfinitesimalConstraint::Evaluate(const Vector &u, const Vector &p,
                                       Vector &gap, Vector &jump,
                                       Vector &pressure)
{
   operators.gap->Mult(u, gap);
   MultJump(*operators.jump, geometry.Destination(), p, jump, pressure);
   gap.HostReadWrite();
   for (int j = 0; j < gap.Size(); j++)
   {
      gap[j] +=
         gap_offset[j] + (operators.area[j] > 0.0 ? removed_overlap[j] : 0.0);
   }
}

ContactFactors InfinitesimalConstraint::Factors() const
{
   ContactFactors factors;
   factors.gap = factors.gap_change = operators.gap.get();
   factors.jump = operators.jump.get();
   return factors;
}

void InfinitesimalConstraint::Archive(StateArchive &archive,
                                      const std::string &prefix)
{
   archive.Flag(prefix + "reached", reached);
   geometry.Destination().Archive(archive, prefix + "removed_overlap",
                                  removed_overlap);
   bool keeps = searched_at.Size() > 0;
   archive.Flag(prefix + "searched", keeps);
   ParFiniteElementSpace &space =
      geometry.Destination().Spaces().Displacement();
   searched_at.SetSize(keeps ? space.GetTrueVSize() : 0);
   if (keeps)
   {
      archive.Field(prefix + "searched_at", space, searched_at);
   }
   searched = searched && !archive.Reads();
}

} // namespace synovia
