#pragma once

#include "synovia/general/point3.hpp"

namespace synovia
{

/// In rad, from 0 to pi; accurate near both.
inline mfem::real_t AngleBetween(const Point3 &a, const Point3 &b)
{
   return std::atan2(Length(Cross(a, b)), Dot(a, b));
}

} // namespace synovia
