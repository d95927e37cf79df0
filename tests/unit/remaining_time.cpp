// ranks: 1
//
// The estimate of the time that a run still takes.

#include "synovia/io/remaining_time.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <vector>

using namespace synovia;

TEST_CASE("Nothing is said before it means something")
{
   RemainingTime time;
   CHECK_FALSE(time.Seconds());
   time.Add(50.0, 99);
   CHECK_FALSE(time.Seconds());
   time.Add(0.1, 98);
   CHECK_FALSE(time.Seconds());
   time.Add(0.1, 97);
   REQUIRE(time.Seconds());
}

TEST_CASE("A long first step, which sets up, does not count")
{
   RemainingTime time;
   time.Add(50.0, 99);
   for (int left = 98; left > 0; left--)
   {
      time.Add(0.1, left);
      if (left < 98)
      {
         REQUIRE(time.Seconds());
         CHECK(*time.Seconds() == Approx(0.1 * left));
      }
   }
   time.Add(0.1, 0);
   CHECK(time.Seconds() == 0.0);
}

TEST_CASE("The last steps count more than the first ones")
{
   // Contact begins after ten steps and makes them a hundred times as long.
   RemainingTime time;
   int left = 100;
   for (int i = 0; i < 10; i++)
   {
      time.Add(0.01, --left);
   }
   for (int i = 0; i < 20; i++)
   {
      time.Add(1.0, --left);
   }
   REQUIRE(time.Seconds());
   CHECK(*time.Seconds() > 0.85 * left);
   CHECK(*time.Seconds() <= 1.0 * left);
}

TEST_CASE("Output now and then makes no wild estimates")
{
   RemainingTime time;
   const int steps = 200;
   for (int i = 1; i < steps; i++)
   {
      time.Add(i % 10 == 0 ? 2.0 : 1.0, steps - i);
      if (i > 20)
      {
         REQUIRE(time.Seconds());
         const double exact = 1.1 * (steps - i);
         CHECK(*time.Seconds() == Approx(exact).epsilon(0.08));
      }
   }
}

TEST_CASE("There is no estimate while adaptive steps grow")
{
   // Each step is twice as long as the one before, up to 10 of 1000; the number
   // that is left follows from the length of the next.
   RemainingTime time;
   double length = 0.01;
   double at = 0.0;
   std::vector<double> errors;
   int without = 0;
   while (at < 1000.0)
   {
      at += length;
      length = std::min(2.0 * length, 10.0);
      const int left =
         static_cast<int>(std::max(0.0, (1000.0 - at) / length + 0.999));
      time.Add(1.0, left);
      if (time.Seconds() && left > 0)
      {
         errors.push_back(*time.Seconds() / left);
      }
      without += time.Seconds() ? 0 : 1;
   }
   CHECK(without >= 10);
   REQUIRE(errors.size() > 80);
   CHECK(*std::max_element(errors.begin(), errors.end()) < 1.01);
   CHECK(*std::min_element(errors.begin(), errors.end()) > 0.99);
}
