#include "synovia/materials/solids/ellipsoidal_fiber_distribution.hpp"

#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
// Stresses are within 1 % of the integral's.
constexpr int sphere_divisions = 10;

real_t Ellipsoid(const Point3 &semiaxes, const Vector3<> &n)
{
   real_t square = 0.0;
   for (int i = 0; i < 3; i++)
   {
      square += n[i] * n[i] / (semiaxes[i] * semiaxes[i]);
   }
   return 1.0 / std::sqrt(square);
}
} // namespace

LawDescription EllipsoidalFiberDistribution::Describe()
{
   LawDescription law{"ellipsoidal_fiber_distribution",
                      "fibers in all directions with a power law in tension "
                      "whose constants are ellipsoids",
                      Deformation::finite,
                      {}};
   law.vectors = {{"beta",
                   "",
                   "the exponents beta along r, theta, z",
                   NumberRange::AtLeast(2.0),
                   {}},
                  {"ksi",
                   "stress",
                   "the moduli ksi along r, theta, z",
                   NumberRange::Positive(),
                   {}}};
   return law;
}

EllipsoidalFiberDistribution::EllipsoidalFiberDistribution(
   const LawArguments &from)
   : EllipsoidalFiberDistribution(from.Vector("beta"), from.Vector("ksi"),
                                  from.frame)
{
}

EllipsoidalFiberDistribution::EllipsoidalFiberDistribution(
   const Point3 &beta, const Point3 &xi, const MaterialFrame &frame)
   : EllipsoidalFiberDistribution(DirectionRule(sphere_divisions), beta, xi,
                                  frame)
{
}

EllipsoidalFiberDistribution::EllipsoidalFiberDistribution(
   const std::vector<WeightedDirection> &rule, const Point3 &beta,
   const Point3 &xi, const MaterialFrame &frame)
   : FiberDistribution(rule, frame)
{
   const LawDescription law = Describe();
   law.vectors[0].Verify(beta);
   law.vectors[1].Verify(xi);
   for (const WeightedDirection &one : rule)
   {
      powers.push_back(
         {Ellipsoid(beta, one.direction), Ellipsoid(xi, one.direction)});
   }
}

FiberEnergy::Derivatives
EllipsoidalFiberDistribution::Differentiate(int direction, real_t square) const
{
   const PowerLaw &law = powers[direction];
   const real_t excess = square - 1.0;
   const real_t power =
      law.beta == 2.0 ? 1.0 : std::pow(excess, law.beta - 2.0);
   const real_t slope = law.xi * law.beta * power;
   return {slope * excess, slope * (law.beta - 1.0)};
}

} // namespace synovia
