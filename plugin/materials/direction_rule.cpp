#include "synovia/materials/direction_rule.hpp"

#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
Vector3<> Unit(const Vector3<> &a)
{
   return (1.0 / std::sqrt(InnerProduct(a, a))) * a;
}

// The solid angle of the triangle between three unit vectors (Van Oosterom &
// Strackee 1983).
real_t SolidAngle(const Vector3<> &a, const Vector3<> &b, const Vector3<> &c)
{
   const real_t volume = a[0] * (b[1] * c[2] - b[2] * c[1]) +
                         a[1] * (b[2] * c[0] - b[0] * c[2]) +
                         a[2] * (b[0] * c[1] - b[1] * c[0]);
   return 2.0 * std::atan2(std::abs(volume), 1.0 + InnerProduct(a, b) +
                                                InnerProduct(b, c) +
                                                InnerProduct(c, a));
}
} // namespace

std::vector<WeightedDirection> DirectionRule(int divisions)
{
   // Of equal angles along the edges of the octant, so that the triangles are
   // much alike.
   const auto vertex = [&](int i, int j) -> Vector3<>
   {
      const auto part = [&](int k)
      { return std::sin(0.5 * M_PI * k / divisions); };
      return Unit({part(i), part(j), part(divisions - i - j)});
   };
   std::vector<WeightedDirection> directions;
   const auto add =
      [&](const Vector3<> &a, const Vector3<> &b, const Vector3<> &c)
   {
      const Vector3<> center = Unit(a + b + c);
      const real_t weight = 2.0 * SolidAngle(a, b, c);
      for (const real_t x : {center[0], -center[0]})
      {
         for (const real_t y : {center[1], -center[1]})
         {
            directions.push_back({{x, y, center[2]}, weight});
         }
      }
   };
   for (int i = 0; i < divisions; i++)
   {
      for (int j = 0; i + j < divisions; j++)
      {
         add(vertex(i, j), vertex(i + 1, j), vertex(i, j + 1));
         if (i + j < divisions - 1)
         {
            add(vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1));
         }
      }
   }
   return directions;
}

} // namespace synovia
