#pragma once

#include "synovia/contact/contact_surface.hpp"

#include <vector>

namespace synovia
{

/// A quadrature point of a destination face, on the part of it that one source
/// face covers.
struct SegmentPoint
{
   /// Where on the destination face, and its weight in reference coordinates.
   mfem::IntegrationPoint ip;
   /// About how far along the normal that source face is (length).
   mfem::real_t distance = 0.0;
   /// Size of that source face (length).
   mfem::real_t size = 0.0;
   /// Which face it is, as in SearchHit; -1 where segments overlap, so that
   /// only a search can tell.
   int rank = -1;
   int face = -1;
};

/// Quadrature points on each of the @a destination's faces that follow the
/// faces of the @a source.
///
/// Along the normals of the destination, source faces are projected to its
/// reference coordinates and clipped; every polygon that results gets a rule of
/// its own. So no kink of the source's fields, and none of its edges, lies
/// within a segment, and integrals over surfaces that are flat with straight
/// edges are exact: the contact patch test holds to round-off. Edges that are
/// bent by more than a thousandth of their length get a corner in the middle.
/// Destination parts without a source have no points.
///
/// Collective. Both surfaces are taken in their current configuration. Source
/// faces turned away, or farther than @a radius, don't count. @a order is that
/// of the rules.
std::vector<std::vector<SegmentPoint>>
SegmentSurface(const ContactSurface &source, const ContactSurface &destination,
               mfem::real_t radius, int order);

} // namespace synovia
