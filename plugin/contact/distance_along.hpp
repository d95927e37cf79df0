#pragma once

#include "synovia/contact/contact_surface.hpp"

namespace synovia
{

/// How far surface @a mover can go along the unit vector @a direction until it
/// meets @a other (length); infinite if it doesn't within @a farthest.
///
/// Found by rays from points of either surface's faces to the other, both in
/// their current configuration: somewhat too large where surfaces are round.
/// Collective.
mfem::real_t DistanceAlong(const ContactSurface &mover,
                           const ContactSurface &other, const Point3 &direction,
                           mfem::real_t farthest);

} // namespace synovia
