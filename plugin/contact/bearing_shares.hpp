#pragma once

#include "synovia/contact/surface_pairing.hpp"

namespace synovia
{

/// The angle at which surfaces face each other around each of this rank's
/// vertices of the destination (radians), where they do so best: the mean with
/// weights phi_j exp(-2 angle / @a bearing_angle); zero where there are no
/// points. Collective.
mfem::Vector LeastAngles(const SurfacePairing &pairing,
                         mfem::real_t bearing_angle);

/// Sets PairedPoint::share: of each vertex's multiplier, what is borne by
/// points where the surfaces face each other about as well as they do best
/// around the vertex. With theta the angle of a point, theta_j that of the
/// vertex and b the @a bearing_angle, that is
///
///     1 up to theta - theta_j = b, falling linearly to 0 at 4 b.
///
/// So at the vertices of a rounded edge, where one face may touch and the next
/// turns away, gaps are those of the first, and don't depend on how much of the
/// other one has a partner. Angles hardly change in a step; shares by distance
/// would follow each iteration.
///
/// Collective. @a least: theta_j for each of this rank's vertices of the
/// @a destination. @a points: of its faces.
void SetBearingShares(const ContactSurface &destination,
                      const mfem::Vector &least, mfem::real_t bearing_angle,
                      std::vector<PairedPoint> &points);

} // namespace synovia
