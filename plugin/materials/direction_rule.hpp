#pragma once

#include "synovia/materials/tensor3.hpp"

#include <vector>

namespace synovia
{

/// A direction of half a sphere, which stands for its opposite, too.
struct WeightedDirection
{
   Vector3<> direction;
   /// The solid angle of both.
   mfem::real_t weight;
};

/// The centers of 4 x @a divisions^2 triangles on half of the unit sphere, as
/// many in each octant: a rule for the integral of an even function. The
/// weights add up to 4 pi. The rule is symmetric about the planes of
/// coordinates and under exchange of axes.
std::vector<WeightedDirection> DirectionRule(int divisions);

} // namespace synovia
