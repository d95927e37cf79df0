// ranks: 1 2 3
//
// Pairs of infinitesimal strain that have hardly slid keep the operators of
// where they looked for each other last; gaps are those of where they are.

#include "support/touching_blocks.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/io/state_snapshot.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t kept_slide = 0.1;
/// The edges of the lower block's faces.
constexpr real_t face = 0.2;
/// Slides that are less and more than is kept, for whole faces around a vertex
/// as for those of a corner.
constexpr real_t little = 0.2 * kept_slide * face;
constexpr real_t much = 1.2 * kept_slide * face;

TouchingBlocksOptions Options(real_t kept, int order = 1)
{
   TouchingBlocksOptions options;
   options.configuration = SearchConfiguration::current;
   options.order = order;
   options.curved = order > 1;
   options.tuning.kept_slide = kept;
   return options;
}

class SlidingBlocks : public TouchingBlocks
{
public:
   using TouchingBlocks::TouchingBlocks;

   /// Says whether there are other operators than before.
   bool Search(real_t slide) { return pair->Search(Displacement(slide)); }
   const Vector &Gap(real_t slide)
   {
      Vector pressure(spaces.Pressure().GetTrueVSize());
      pressure = 0.0;
      pair->Enforcement().Evaluate(Displacement(slide), pressure);
      return pair->State().gap;
   }
   const ContactCoverage &Coverage() const
   {
      return pair->Constraint().Coverage();
   }
};

real_t DistanceOf(const Vector &a, const Vector &b)
{
   Vector difference(a);
   difference -= b;
   return NormOf(difference);
}

/// Over all ranks, where both see the source.
real_t LargestGapChange(SlidingBlocks &a, SlidingBlocks &b, real_t slide)
{
   const Vector &gap = a.Gap(slide);
   const Vector &other = b.Gap(slide);
   real_t largest = 0.0;
   for (int j = 0; j < gap.Size(); j++)
   {
      if (a.Coverage().area[j] > 0.0 && b.Coverage().area[j] > 0.0)
      {
         largest = std::max(largest, std::abs(gap[j] - other[j]));
      }
   }
   return MaxOverRanks(largest, MPI_COMM_WORLD);
}
} // namespace

TEST_CASE("Operators are kept until the surfaces have slid by a part of a face")
{
   const int order = GENERATE(1, 2);
   CAPTURE(order);
   SlidingBlocks kept(Options(kept_slide, order));
   SlidingBlocks anew(Options(0.0, order));
   CHECK(kept.Search(0.0));
   const Vector area = kept.Coverage().area;
   const HypreParMatrix *const gap = kept.pair->Factors().gap;
   for (const real_t slide : {little, 0.5 * little, -little})
   {
      CHECK(!kept.Search(slide));
      CHECK(kept.pair->Factors().gap == gap);
      CHECK(DistanceOf(kept.Coverage().area, area) == 0.0);
      CHECK(anew.Search(slide));
      CHECK(DistanceOf(anew.Coverage().area, area) > 1e-3 * NormOf(area));
      CHECK(LargestGapChange(kept, anew, slide) < 1e-12);
   }
   // What counts is how far they have slid in all.
   CHECK(kept.Search(much));
   CHECK(anew.Search(much));
   CHECK(DistanceOf(kept.Coverage().area, anew.Coverage().area) == 0.0);
   CHECK(!kept.Search(much + little));
   CHECK(kept.Search(0.0));
   CHECK(DistanceOf(kept.Coverage().area, area) == 0.0);
}

TEST_CASE("Surfaces that move together, or apart, have not slid")
{
   SlidingBlocks kept(Options(kept_slide));
   kept.Search(0.0);
   ParGridFunction motion(&kept.spaces.Displacement());
   const auto search_after = [&](const Vector &translation)
   {
      VectorConstantCoefficient field(translation);
      motion.ProjectCoefficient(field);
      Vector u;
      motion.GetTrueDofs(u);
      u += kept.Displacement(0.0);
      return kept.pair->Search(u);
   };
   CHECK(!search_after(Vector({1.0, -2.0, 0.5})));
   Vector u = kept.Displacement(0.0);
   const Array<int> &upper =
      kept.pair->Geometry().Source().DisplacementTrueDofs();
   for (int i = 2; i < upper.Size(); i += 3)
   {
      u[upper[i]] += 0.02;
   }
   CHECK(!kept.pair->Search(u));
}

TEST_CASE("Without a part of a face to keep, and after a failed step, each "
          "search finds other operators")
{
   SlidingBlocks none(Options(0.0));
   CHECK(none.Search(0.0));
   CHECK(none.Search(0.0));
   SlidingBlocks kept(Options(kept_slide));
   kept.Search(0.0);
   CHECK(!kept.Search(little));
   kept.pair->StartStep(kept.Displacement(little), false);
   CHECK(!kept.Search(little));
   kept.pair->StartStep(kept.Displacement(little), true);
   CHECK(kept.Search(little));
   CHECK(!kept.Search(little));
}

TEST_CASE("A run that goes on from another one keeps the operators it had")
{
   SlidingBlocks first(Options(kept_slide));
   first.Search(0.0);
   CHECK(!first.Search(little));
   StateSnapshot state;
   first.pair->Archive(state);
   state.Rewind();
   SlidingBlocks second(Options(kept_slide));
   second.pair->Archive(state);
   // Others than it had itself, which is none.
   CHECK(second.Search(-little));
   CHECK(!first.Search(-little));
   CHECK(DistanceOf(second.Coverage().area, first.Coverage().area) == 0.0);
   CHECK(DistanceOf(second.Gap(little), first.Gap(little)) == 0.0);
   CHECK(second.Search(much));
   CHECK(first.Search(much));
   // And back, in the same run.
   state.Rewind();
   first.pair->Archive(state);
   CHECK(first.Search(little));
   SlidingBlocks third(Options(0.0));
   third.Search(0.0);
   CHECK(DistanceOf(first.Coverage().area, third.Coverage().area) == 0.0);
}
