#pragma once

#include "mfem.hpp"

#include <array>
#include <vector>

namespace synovia
{

/// A point of the plane, in the reference coordinates of a face.
using Point2 = std::array<mfem::real_t, 2>;

/// A polygon by its corners in order, either sense.
using Polygon = std::vector<Point2>;

/// The part of @a polygon within the reference triangle or square, by
/// Sutherland and Hodgman's method (Commun ACM 17:32-42, 1974); empty if there
/// is none. Of a polygon that is not convex, parts may be joined by edges that
/// are passed twice and enclose nothing.
Polygon ClipToReference(const Polygon &polygon, mfem::Geometry::Type geometry);

/// Signed area, positive where the corners go round counter-clockwise.
mfem::real_t SignedArea(const Polygon &polygon);

/// Points and weights of a rule on a polygon: that of MFEM on the triangles of
/// a fan, exact for polynomials of the @a order. The weights are signed as the
/// area is; they add up to it.
void AppendRule(const Polygon &polygon, int order,
                std::vector<mfem::IntegrationPoint> &points);

} // namespace synovia
