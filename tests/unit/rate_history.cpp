// ranks: 1 2
//
// The rate that the next stage may be expected to have, from those before.

#include "synovia/physics/rate_history.hpp"
#include "support/boxes.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t tiny = 1e-14;

class Stages
{
public:
   Stages() : mesh(MakeBox(BoxOptions())), spaces(mesh.Get(), 1) {}

   int Size() const { return spaces.Offsets().Last(); }
   Vector Rate(real_t value) const
   {
      Vector rate(Size());
      rate = value;
      return rate;
   }
   /// Of the expected rate from one whose entries are all @a value.
   real_t Distance(const RateHistory &rates, real_t time, real_t value) const
   {
      Vector difference = rates.Expected(time);
      REQUIRE(difference.Size() == Size());
      for (real_t &entry : difference)
      {
         entry -= value;
      }
      return MaxOverRanks(difference.Normlinf(), spaces.GetComm());
   }

   NamedMesh mesh;
   BiphasicSpaces spaces;
};
} // namespace

TEST_CASE("Rates on a line are expected to stay on it, whatever the steps")
{
   Stages stages;
   RateHistory rates(stages.spaces);
   const auto line = [](real_t t) { return 1.0 + 0.5 * t; };
   CHECK(stages.Distance(rates, 1.0, 0.0) == 0.0);
   for (const real_t time : {1.0, 2.0, 4.0})
   {
      rates.Add(time, 1.0, stages.Rate(line(time)));
   }
   CHECK(stages.Distance(rates, 5.0, line(5.0)) < tiny);
   CHECK(stages.Distance(rates, 9.0, line(9.0)) < tiny);
   // So far differences say nothing.
   CHECK(stages.Distance(rates, 11.0, line(4.0)) == 0.0);
}

TEST_CASE("Rates are not expected on a line across a corner")
{
   Stages stages;
   RateHistory rates(stages.spaces);
   const auto corner = [](real_t t) { return t <= 3.0 ? t : 3.0 - 5.0 * t; };
   for (const real_t time : {1.0, 2.0, 3.0})
   {
      rates.Add(time, 1.0, stages.Rate(corner(time)));
   }
   CHECK(stages.Distance(rates, 4.0, 4.0) < tiny);
   for (const real_t time : {4.0, 5.0})
   {
      rates.Add(time, 1.0, stages.Rate(corner(time)));
      CHECK(stages.Distance(rates, time + 1.0, corner(time)) == 0.0);
   }
   rates.Add(6.0, 1.0, stages.Rate(corner(6.0)));
   CHECK(stages.Distance(rates, 7.0, corner(7.0)) < 100.0 * tiny);
}

TEST_CASE("What is forgotten is not expected")
{
   Stages stages;
   RateHistory rates(stages.spaces);
   rates.Add(1.0, 1.0, stages.Rate(2.0));
   rates.Forget();
   CHECK(rates.Last().Normlinf() == 0.0);
   CHECK(stages.Distance(rates, 2.0, 0.0) == 0.0);
}
