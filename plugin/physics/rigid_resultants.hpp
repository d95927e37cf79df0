#pragma once

#include "synovia/fem/boundary_conditions.hpp"

namespace synovia
{

/// The force on each rigid body that it is free to follow, as a resultant along
/// the direction in which it begins to act; bodies without one are left out, as
/// are those that springs or ligaments hold along it.
std::vector<DrivenSurface>
FindRigidResultants(const BoundaryConditions &conditions);

/// Whether a rigid body can't follow a motion along @a direction: what it would
/// take is prescribed, by a joint too, or sprung, or it would lengthen a
/// ligament, or shorten a spring between points.
bool Holds(const BoundaryConditions &conditions, const RigidBody &body,
           const Point3 &direction);

} // namespace synovia
