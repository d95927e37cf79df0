// ranks: 1

#include "synovia/general/load_curve.hpp"
#include "synovia/general/error.hpp"

#include <catch2/catch.hpp>

#include <limits>

using namespace mfem;
using namespace synovia;

TEST_CASE("A constant load curve is constant and has one corner")
{
   const LoadCurve curve(-0.3);
   for (const real_t t : {-1.0, 0.0, 1e6})
   {
      CHECK(curve(t) == -0.3);
   }
   CHECK(curve.Corners() == std::vector<real_t>{0.0});
}

TEST_CASE("A load curve is linear between its points and constant outside")
{
   const LoadCurve curve({1.0, 2.0, 4.0}, {10.0, -10.0, 0.0});
   CHECK(curve(0.0) == 10.0);
   CHECK(curve(1.0) == 10.0);
   CHECK(curve(1.25) == Approx(5.0));
   CHECK(curve(2.0) == -10.0);
   CHECK(curve(3.0) == Approx(-5.0));
   CHECK(curve(4.0) == 0.0);
   CHECK(curve(5.0) == 0.0);
   CHECK(curve.Corners() == std::vector<real_t>{1.0, 2.0, 4.0});
}

TEST_CASE("A load curve of one point is constant")
{
   const LoadCurve curve({3.0}, {2.0});
   CHECK(curve(0.0) == 2.0);
   CHECK(curve(3.0) == 2.0);
   CHECK(curve(9.0) == 2.0);
}

TEST_CASE("A ramp rises and holds")
{
   const LoadCurve ramp = Ramp(500.0, -0.075);
   CHECK(ramp(0.0) == 0.0);
   CHECK(ramp(250.0) == Approx(-0.0375));
   CHECK(ramp(500.0) == -0.075);
   CHECK(ramp(501.0) == -0.075);
}

TEST_CASE("A load curve repeats one period after the other")
{
   const LoadCurve curve({1.0, 2.0, 4.0}, {10.0, -10.0, 10.0});
   const LoadCurve thrice = curve.Repeated(3);
   CHECK(thrice.Corners() ==
         std::vector<real_t>{1.0, 2.0, 4.0, 5.0, 7.0, 8.0, 10.0});
   for (const real_t t : {1.0, 1.5, 2.0, 3.5})
   {
      CHECK(thrice(t + 3.0) == Approx(curve(t)));
      CHECK(thrice(t + 6.0) == Approx(curve(t)));
   }
   CHECK(thrice(0.0) == 10.0);
   CHECK(thrice(20.0) == 10.0);
   CHECK(curve.Repeated(1).Corners() == curve.Corners());
   CHECK(LoadCurve(3.0).Repeated(1)(5.0) == 3.0);
   CHECK_THROWS_WITH(Ramp(1.0, 2.0).Repeated(2),
                     Catch::Contains("end with the value that it begins with"));
   CHECK_THROWS_AS(LoadCurve(3.0).Repeated(2), Error);
}

TEST_CASE("Load curves that make no sense are refused")
{
   const real_t nan = std::numeric_limits<real_t>::quiet_NaN();
   const real_t infinity = std::numeric_limits<real_t>::infinity();
   CHECK_THROWS_WITH(LoadCurve({0.0, 1.0}, {0.0}),
                     "a load curve has 2 times and 1 values; give as many "
                     "values as times, at least one");
   CHECK_THROWS_WITH(LoadCurve({}, {}),
                     Catch::Contains("0 times and 0 values"));
   CHECK_THROWS_WITH(LoadCurve({0.0, 1.0}, {0.0, nan}),
                     "a load curve has a time or a value that is not finite");
   CHECK_THROWS_WITH(LoadCurve({0.0, infinity}, {0.0, 1.0}),
                     Catch::Contains("not finite"));
   CHECK_THROWS_WITH(LoadCurve({0.0, 2.0, 1.0}, {0.0, 1.0, 2.0}),
                     Catch::Contains("must ascend: 1") &&
                        Catch::Contains("follows 2"));
   // Twice the same time would be a jump, of which it is not clear on which
   // side the time itself is.
   CHECK_THROWS_AS(LoadCurve({0.0, 1.0, 1.0}, {0.0, 1.0, 2.0}), Error);
   CHECK_THROWS_AS(Ramp(0.0, 1.0), Error);
   CHECK_THROWS_AS(Ramp(-1.0, 1.0), Error);
}
