// ranks: 1
//
// The limit of friction and its derivatives against differences, and the turn
// that takes tractions from one normal to the next.

#include "synovia/contact/friction_law.hpp"
#include "synovia/contact/tangential_turn.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

TEST_CASE("Friction has its limit on the solid's share of the load")
{
   const FrictionLaw law(0.3, 0.04);
   SECTION("as Zimmerman & Ateshian have it")
   {
      for (const real_t support : {0.0, 0.2, 0.9, 1.0})
      {
         const real_t expected = 0.3 * (1.0 - 0.96 * support);
         CHECK(law.Effective(-2.0, 2.0 * support) == Approx(expected));
         CHECK(law.Limit(-2.0, 2.0 * support) == Approx(2.0 * expected));
      }
   }
   SECTION("which is never negative")
   {
      CHECK(law.Effective(-2.0, 2.0 / 0.96) == Approx(0.0).margin(1e-15));
      CHECK(law.Limit(-2.0, 2.2) == 0.0);
      CHECK(law.Effective(-2.0, 2.2) == 0.0);
   }
   SECTION("and nothing in tension")
   {
      CHECK(law.Limit(0.1, -1.0) == 0.0);
      CHECK(law.Effective(0.1, -1.0) == 0.0);
      CHECK(law.Effective(0.0, 0.0) == 0.0);
   }
   SECTION("with its derivatives")
   {
      constexpr real_t h = 1e-6;
      for (const real_t pressure : {-0.5, 0.3, 1.5})
      {
         const real_t by_traction =
            (law.Limit(-2.0 + h, pressure) - law.Limit(-2.0 - h, pressure)) /
            (2.0 * h);
         const real_t by_pressure =
            (law.Limit(-2.0, pressure + h) - law.Limit(-2.0, pressure - h)) /
            (2.0 * h);
         CHECK(law.ByTraction() == Approx(by_traction).epsilon(1e-8));
         CHECK(law.ByPressure() == Approx(by_pressure).epsilon(1e-8));
      }
   }
}

namespace
{
Point3 Unit(Point3 v)
{
   const real_t length = Length(v);
   return {v[0] / length, v[1] / length, v[2] / length};
}

real_t Distance(const Point3 &a, const Point3 &b)
{
   return Length(Sum(a, -1.0, b));
}
} // namespace

TEST_CASE("Tractions turn with the normal")
{
   const Point3 from = Unit({{0.2, -0.3, 1.0}});
   const Point3 to = Unit({{0.6, 0.1, 0.9}});
   const Point3 v = Cross(from, {{0.3, 0.8, -0.4}});
   const TangentialTurn turn(from, to);
   const Point3 turned = turn(v);
   CHECK(std::abs(Dot(turned, to)) <= 1e-15);
   CHECK(Length(turned) == Approx(Length(v)));
   // What is along the axis stays.
   const Point3 axis = Cross(from, to);
   CHECK(Distance(turn(axis), axis) <= 1e-15);
   CHECK(Distance(TangentialTurn(to, from)(turned), v) <= 1e-15);
   CHECK(Distance(TangentialTurn(from, from)(v), v) <= 1e-15);
   // Nothing to turn from.
   const Point3 none{{0.0, 0.0, 0.0}};
   const Point3 across = TangentialTurn(none, to)(v);
   CHECK(Distance(across, Sum(v, -Dot(v, to), to)) <= 1e-15);
}

TEST_CASE("The derivative of a turn is that of its differences")
{
   constexpr real_t h = 1e-6;
   const Point3 v{{0.3, 0.8, -0.4}};
   const Point3 to = Unit({{0.6, 0.1, 0.9}});
   for (const Point3 &from :
        {Unit({{0.2, -0.3, 1.0}}), Point3{{0.0, 0.0, 0.0}}})
   {
      const Matrix3 derivative = TangentialTurn(from, to).Derivative(v);
      for (int j = 0; j < 3; j++)
      {
         Point3 ahead(to);
         Point3 behind(to);
         ahead[j] += h;
         behind[j] -= h;
         const Point3 after = TangentialTurn(from, ahead)(v);
         const Point3 before = TangentialTurn(from, behind)(v);
         for (int i = 0; i < 3; i++)
         {
            const real_t difference = (after[i] - before[i]) / (2.0 * h);
            CHECK(derivative[i][j] == Approx(difference).margin(1e-9));
         }
      }
   }
}
