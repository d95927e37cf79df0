#include "synovia/contact/contact_geometry.hpp"
#include "synovia/fem/node_positions.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/general/text.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

ContactGeometry::ContactGeometry(const std::string &pair_,
                                 BiphasicSpaces &spaces,
                                 const Array<int> &source_boundary,
                                 const Array<int> &destination_boundary,
                                 const ContactScales &scales,
                                 const ContactOptions &contact,
                                 const ContactTuning &tuning)
   : pair(pair_), comm(spaces.GetComm()), source(spaces, source_boundary),
     destination(spaces, destination_boundary),
     least_coverage(tuning.least_coverage), overlap_limit(scales.overlap_limit),
     source_areas(NodalAreas(source)),
     destination_areas(NodalAreas(destination))
{
   const Vector nodes = NodePositions(spaces.Displacement());
   nodes.HostRead();
   nodes.GetSubVector(source.DisplacementTrueDofs(),
                      source_positions.reference);
   nodes.GetSubVector(destination.DisplacementTrueDofs(),
                      destination_positions.reference);
   source_positions.now = source_positions.reference;
   destination_positions.now = destination_positions.reference;
   options.search_radius = scales.search_radius;
   options.quadrature_order = contact.quadrature_order;
   options.normal = contact.normal;
   options.rim_coverage = tuning.rim_coverage;
   int shared = 0;
   for (const int dof : source.Vertices().TrueDofs())
   {
      shared += destination.Vertices().TrueDofs().FindSorted(dof) >= 0;
   }
   if (AnyRank(shared > 0, comm))
   {
      throw Error("contact pair \"" + pair +
                  "\": source and destination share vertices; the two bodies "
                  "must have meshes of their own, without common nodes");
   }
}

void ContactGeometry::SetDisplacement(const Vector &u)
{
   u.HostRead();
   source.SetDisplacement(u);
   destination.SetDisplacement(u);
   const auto move = [&u](const ContactSurface &surface, Positions &positions)
   {
      u.GetSubVector(surface.DisplacementTrueDofs(), positions.now);
      positions.now += positions.reference;
   };
   move(source, source_positions);
   move(destination, destination_positions);
}

GapOperators ContactGeometry::Search() const
{
   GapOperators operators = AssembleGapOperators(source, destination, options);
   LeaveOutSlivers(operators);
   return operators;
}

void ContactGeometry::LeaveOutSlivers(ContactCoverage &coverage) const
{
   for (int j = 0; j < coverage.area.Size(); j++)
   {
      if (coverage.area[j] < least_coverage * destination_areas[j])
      {
         coverage.area[j] = 0.0;
      }
   }
}

void ContactGeometry::VerifyReach(const ContactCoverage &coverage) const
{
   if (!(SumOverRanks(coverage.area.Sum(), comm) > 0.0))
   {
      throw Error("contact pair \"" + pair +
                  "\": looking along the normals of the destination, no point "
                  "of the source is within the search radius of " +
                  ToText(options.search_radius) +
                  "; check the names of the surfaces and the initial gap, or "
                  "give a larger search_radius");
   }
}

Vector ContactGeometry::FindOverlap(const ContactCoverage &coverage,
                                    const Vector &gap) const
{
   Vector overlap(gap.Size());
   for (int j = 0; j < gap.Size(); j++)
   {
      overlap[j] = coverage.area[j] > 0.0 ? std::max(0.0, -gap[j]) : 0.0;
   }
   const real_t deepest =
      MaxOverRanks(overlap.Size() > 0 ? overlap.Max() : 0.0, comm);
   if (deepest > overlap_limit)
   {
      throw Error("contact pair \"" + pair +
                  "\": the surfaces overlap by up "
                  "to " +
                  ToText(deepest) +
                  " as meshed, more than "
                  "overlap_limit = " +
                  ToText(overlap_limit) +
                  "; move the bodies apart in the mesh, or allow for more");
   }
   return overlap;
}

} // namespace synovia
