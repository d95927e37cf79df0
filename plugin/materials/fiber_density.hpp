#pragma once

#include "synovia/general/point3.hpp"
#include "synovia/materials/direction_rule.hpp"

namespace synovia
{

/// Density of fibers by their direction n = (n_r, n_theta, n_z), up to a
/// factor: a von Mises distribution about theta times an ellipsoid,
///
///     R(n) = exp(b (2 n_theta^2 - 1)) / sqrt(sum (n_i / a_i)^2).
///
/// Uniform by default.
struct FiberDensity
{
   /// b, from 0 to 100: the larger, the closer to theta; with 100 within some 3
   /// degrees.
   mfem::real_t concentration = 0.0;
   /// The semiaxes a along r, theta, z, positive.
   Point3 semiaxes{{1.0, 1.0, 1.0}};

   mfem::real_t operator()(const Vector3<> &n) const;

   /// Directions with weights R(n) dA / int R dA, which add up to 1: as few as
   /// give the moments of R of order 2 and 4 to 0.1 %. Throws Error if it takes
   /// too many.
   std::vector<WeightedDirection> Rule() const;
};

} // namespace synovia
