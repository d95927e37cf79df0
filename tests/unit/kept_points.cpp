// ranks: 1 2 3
//
// Pairs that hardly slide have the same points from step to step: which steps
// begin with those of former ones, and how far what they cover may lag behind.

#include "support/touching_blocks.hpp"
#include "synovia/fem/node_positions.hpp"
#include "synovia/general/reduce.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t kept_slide = 0.04;
/// The longer edges of the upper block's faces.
constexpr real_t face = 1.0 / 3.0;

TouchingBlocksOptions Options(real_t kept, real_t friction = 0.0)
{
   TouchingBlocksOptions options;
   options.deformation = Deformation::finite;
   options.order = 1;
   options.friction = {friction, 0.3};
   options.tuning.kept_slide = kept;
   return options;
}

/// Time steps in which the upper block goes from slide to slide.
class SlidingSteps
{
public:
   explicit SlidingSteps(const TouchingBlocksOptions &options)
      : blocks(options), pair(*blocks.pair),
        pressure(blocks.spaces.Pressure().GetTrueVSize())
   {
      pressure = 0.0;
   }

   /// Begins a step; says whether it has the points of former ones.
   bool Begin(bool failed = false)
   {
      pair.StartStep(blocks.Displacement(slide), failed);
      const bool keeps = pair.KeepsFound();
      pair.Search(blocks.Displacement(slide));
      return keeps;
   }
   /// Goes on by @a part of a face; says whether points are to be made anew.
   bool Slide(real_t part)
   {
      slide += part * face;
      pair.Enforcement().Evaluate(blocks.Displacement(slide), pressure);
      return pair.HasDrifted();
   }
   /// A whole step; says the same as Begin().
   bool Step(real_t part)
   {
      const bool keeps = Begin();
      Slide(part);
      pair.Enforcement().Accept();
      return keeps;
   }

   const ContactPair &Pair() const { return pair; }
   /// Of what the upper block covers, along x as meshed.
   real_t Center() const
   {
      const Vector positions = NodePositions(blocks.spaces.Displacement());
      const Array<int> &dofs =
         pair.Geometry().Destination().Vertices().TrueDofs();
      const Vector &areas = pair.Constraint().Coverage().area;
      real_t moment = 0.0;
      for (int j = 0; j < areas.Size(); j++)
      {
         moment += areas[j] * positions[3 * dofs[j]];
      }
      return SumOverRanks(moment, MPI_COMM_WORLD) /
             SumOverRanks(areas.Sum(), MPI_COMM_WORLD);
   }
   /// The same if the surfaces look for each other where they are.
   real_t CenterAnew()
   {
      SlidingSteps anew(Options(0.0));
      anew.slide = slide;
      anew.Begin();
      return anew.Center();
   }

private:
   TouchingBlocks blocks;
   ContactPair &pair;
   Vector pressure;
   real_t slide = 0.0;
};
} // namespace

TEST_CASE("Steps have the points of former ones once a step has hardly slid")
{
   SlidingSteps steps(Options(kept_slide));
   CHECK(!steps.Step(0.1));
   CHECK(!steps.Step(0.1));
   CHECK(!steps.Step(0.1 * kept_slide));
   CHECK(steps.Step(0.0));
   const Vector area = steps.Pair().Constraint().Coverage().area;
   CHECK(NormOf(area) > 0.0);
   for (int i = 0; i < 3; i++)
   {
      CHECK(steps.Step(0.1 * kept_slide));
   }
   Vector change(steps.Pair().Constraint().Coverage().area);
   change -= area;
   CHECK(NormOf(change) == 0.0);
}

TEST_CASE("Steps that slide, fail, rub or are not to have none of former ones")
{
   {
      SlidingSteps steps(Options(kept_slide));
      for (int i = 0; i < 3; i++)
      {
         steps.Step(0.0);
      }
      CHECK(!steps.Begin(true));
      CHECK(steps.Begin());
      CHECK(!steps.Slide(0.75 * kept_slide));
      CHECK(steps.Pair().KeepsFound());
      steps.Slide(0.75 * kept_slide);
      CHECK(!steps.Pair().KeepsFound());
   }
   for (const TouchingBlocksOptions &options :
        {Options(0.0), Options(kept_slide, 0.1)})
   {
      SlidingSteps steps(options);
      for (int i = 0; i < 3; i++)
      {
         CHECK(!steps.Step(0.0));
      }
   }
}

TEST_CASE("What is covered follows slow sliding")
{
   SlidingSteps steps(Options(kept_slide));
   steps.Step(0.0);
   const real_t first = steps.Center();
   const int count = 40;
   const real_t part = 0.15 * kept_slide;
   for (int i = 0; i < count; i++)
   {
      CHECK(steps.Step(part));
      CHECK(std::abs(steps.Center() - steps.CenterAnew()) < kept_slide * face);
   }
   CHECK(steps.Center() - first > 0.5 * count * part * face);
}
