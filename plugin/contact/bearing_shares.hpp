#pragma once

#include "synovia/contact/rim_vertices.hpp"
#include "synovia/contact/surface_pairing.hpp"

#include <vector>

namespace synovia
{

/// Of each vertex's multiplier, what is borne by faces where the surfaces face
/// each other about as well as they do best around the vertex. With theta the
/// angle between the normal n of a point's face and the opposite of that of the
/// source where it hits, b the @a bearing_angle (radians), and theta_j and n_j
/// the means of both around the vertex with weights phi_j exp(-2 theta / b),
/// the mean over a face of what is
///
///     1 up to min(theta - theta_j, angle(n, n_j)) = b,
///
/// falling linearly to 0 at 2 b. Faces without points have 1. Vertices of the
/// @a rim take theta_j and n_j from those that have their multipliers.
///
/// So at the vertices of a rounded edge, where one face may touch and the next
/// turns away, gaps are those of the first, and don't depend on how much of the
/// other one has a partner. A flat surface bears all: below the edge of a punch
/// the other one turns away within a face, and it is there that the punch bears
/// most. Angles hardly change in a step; shares by distance would follow each
/// iteration.
///
/// Collective. An entry for each face of the destination of @a pairing.
FaceShares BearingShares(const SurfacePairing &pairing, const RimVertices &rim,
                         mfem::real_t bearing_angle);

} // namespace synovia
