#pragma once

#include "general/point3.hpp"

namespace synovia
{

/// The centre of area of the boundaries with these attributes (length).
/// Collective. Throws Error if they have no area.
Point3 CentreOfArea(mfem::ParMesh &mesh, const mfem::Array<int> &boundaries);

/// The centre of the circle that fits the boundaries with these attributes
/// best, seen along @a axis, of any length: of all circles it leaves the least
/// mean square of |x - c|^2 - R^2 (I. Kasa, IEEE Trans Instrum Meas 25:8-14,
/// 1976). Along the axis it is at their centre of area. Collective. Throws
/// Error if they have no area or lie in a plane along the axis.
Point3 CentreOfCircle(mfem::ParMesh &mesh, const mfem::Array<int> &boundaries,
                      const Point3 &axis);

} // namespace synovia
