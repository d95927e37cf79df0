#pragma once

#include "synovia/fem/boundary_conditions.hpp"

namespace synovia
{

/// The force on each rigid body that it is free to follow, as a resultant along
/// the direction in which it begins to act; bodies without one are left out, as
/// are those that springs hold along it.
std::vector<DrivenSurface>
FindRigidResultants(const std::vector<RigidBody> &bodies);

/// Whether a rigid body can't follow a motion along @a direction: what it would
/// take is prescribed or sprung.
bool Holds(const RigidBodyOptions &body, const Point3 &direction);

} // namespace synovia
