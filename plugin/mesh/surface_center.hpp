#pragma once

#include "synovia/general/point3.hpp"

namespace synovia
{

/// The center of area of the boundaries with these attributes (length).
/// Collective. Throws Error if they have no area.
Point3 CenterOfArea(mfem::ParMesh &mesh, const mfem::Array<int> &boundaries);

/// The center of the circle that fits the boundaries with these attributes
/// best, seen along @a axis, of any length: of all circles it leaves the least
/// mean square of |x - c|^2 - R^2 (I. Kasa, IEEE Trans Instrum Meas 25:8-14,
/// 1976). Along the axis it is at their center of area. Collective. Throws
/// Error if they have no area or lie in a plane along the axis.
Point3 CenterOfCircle(mfem::ParMesh &mesh, const mfem::Array<int> &boundaries,
                      const Point3 &axis);

} // namespace synovia
