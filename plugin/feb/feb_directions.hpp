#pragma once

#include "synovia/feb/feb_axes.hpp"

namespace synovia
{

const Point3 x_axis{{1.0, 0.0, 0.0}};
const Point3 y_axis{{0.0, 1.0, 0.0}};
const Point3 z_axis{{0.0, 0.0, 1.0}};

/// The vector in a child; that of length 1 along it, and @a from stops, if it
/// is zero.
Point3 VectorIn(const FebInput &from, const std::string &child,
                const Point3 &standard);
Point3 DirectionIn(const FebInput &from, const std::string &child,
                   const Point3 &standard);

/// A unit vector: theta from the first axis towards the second, phi from the
/// third, in degrees.
Point3 FromAngles(mfem::real_t theta, mfem::real_t phi);

/// The smallest turn of one unit vector to another, applied to a third; a half
/// turn is about z.
Point3 Turned(const Point3 &from, const Point3 &to, const Point3 &vector);

/// The element vector in @a from, for each cell of a part, turned as the first
/// axis is turned outwards from the element center. Borrows what @a elements
/// does.
std::function<Point3(const FebCell &, int part)>
SphericalVectors(const FebInput &from, const FebElements &elements);

/// The vector to a point from the nearest one of an axis.
Point3 FromAxis(const Point3 &point, const Point3 &center, const Point3 &axis);

bool IsAlongZ(const Point3 &unit_vector);
/// A frame around a line along z.
FrameCase CylinderAlongZ(const Point3 &center);

/// Numbers, from 1, of so many nodes of each element, 0 where none is given;
/// none, and @a from stops, where elements have fewer.
std::vector<long long> LocalNodes(const FebInput &from, size_t count,
                                  const FebElements &elements);

} // namespace synovia
