// ranks: 1
//
// Families of fibers: directions in the axes of a frame, and what two of them
// do together.

#include "support/deformed_point.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
/// Fibers along a direction by its key.
std::unique_ptr<SolidLaw> Family(const MaterialFrame &frame,
                                 const Point3 &direction)
{
   return SolidLaws().Make(
      "fiber_nh", {{{"mu", 2.0}}, frame, 0.2, {}, {{"direction", direction}}});
}
} // namespace

TEST_CASE("A direction is one in the axes of the frame", "[laws]")
{
   AnyPoint point;
   const CylindricalFrame frame(Point3{{-1.0, 0.5, 0.0}},
                                Point3{{0.0, 0.0, 1.0}});
   // At (0.5, 0.5, 0.5) r is x and theta is y.
   const Vector3<> n = FiberDirection(frame, {{0.0, 3.0, 4.0}})(point.Get());
   CHECK(std::abs(n[0]) < 1e-15);
   CHECK(n[1] == Approx(0.6));
   CHECK(n[2] == Approx(0.8));
   const Vector3<> theta = FiberDirection(frame)(point.Get());
   CHECK(std::abs(theta[0]) < 1e-15);
   CHECK(theta[1] == Approx(1.0));
   CHECK_THROWS_WITH(Family(frame, {{0.0, 0.0, 0.0}}),
                     "the direction of the fibers is zero; give a vector in "
                     "the axes r, theta, z of the frame");
}

TEST_CASE("Two families at 45 degrees make an orthotropic solid", "[laws]")
{
   AnyPoint point;
   // Theta is x; with r and z it is right-handed.
   const CartesianFrame frame(Point3{{1.0, 0.0, 0.0}});
   const Tensor3<> axes = frame.GetAxes(point.Get());
   // Components of y + x and y - x.
   const auto components = [&](real_t x, real_t y)
   {
      Point3 local;
      for (int a = 0; a < 3; a++)
      {
         local[a] = axes[0][a] * x + axes[1][a] * y;
      }
      return local;
   };
   const auto one = Family(frame, components(1.0, 1.0));
   const auto other = Family(frame, components(-2.0, 2.0));
   const IsotropicElastic isotropic(1.0, 0.25); // lambda = mu = 0.4
   const NeoHookean ground(1.0, 0.25);
   const SolidMixture mixture({&ground, one.get(), other.get()});
   DenseMatrix stiffness;
   mixture.GetStiffness(point.Get().trans, point.Get().ip, stiffness);
   // Each family adds 2 mu n (x) n (x) n (x) n, so that both together add
   // 4 mu/4 to xxxx, yyyy, xxyy and xyxy, and nothing else.
   const real_t fibers = 2.0;
   DenseMatrix expected;
   isotropic.GetStiffness(point.Get().trans, point.Get().ip, expected);
   for (const int k : {0, 1, 3})
   {
      expected(k, k) += fibers;
   }
   expected(0, 1) += fibers;
   expected(1, 0) += fibers;
   for (int i = 0; i < 6; i++)
   {
      for (int j = 0; j < 6; j++)
      {
         CAPTURE(i, j);
         CHECK(std::abs(stiffness(i, j) - expected(i, j)) < 1e-10);
      }
   }
   // One family alone couples stretch and shear.
   const SolidMixture single({&ground, one.get()});
   single.GetStiffness(point.Get().trans, point.Get().ip, stiffness);
   CHECK(stiffness(0, 3) == Approx(0.5 * fibers));
}
