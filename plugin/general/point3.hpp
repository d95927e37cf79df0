#pragma once

#include "mfem.hpp"

#include <array>
#include <cmath>

namespace synovia
{

/// A point or a vector of space.
using Point3 = std::array<mfem::real_t, 3>;

inline mfem::real_t Dot(const Point3 &a, const Point3 &b)
{
   return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline mfem::real_t Length(const Point3 &a)
{
   return std::sqrt(Dot(a, a));
}

inline Point3 Cross(const Point3 &a, const Point3 &b)
{
   return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
           a[0] * b[1] - a[1] * b[0]};
}

/// a + s b
inline Point3 Sum(const Point3 &a, mfem::real_t s, const Point3 &b)
{
   return {a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]};
}

} // namespace synovia
