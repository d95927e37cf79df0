// ranks: 1 2 3
//
// What faces bear, and which vertices are at the rim, is kept from where a step
// began, whatever searches follow; points know how far they have slid since
// they were made.

#include "support/boxes.hpp"
#include "support/stack_displacement.hpp"
#include "synovia/contact/finite_gap.hpp"
#include "synovia/fem/node_positions.hpp"
#include "synovia/general/reduce.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
NamedMesh MakeBodies()
{
   BoxOptions box;
   box.nx = 4;
   box.nz = 1;
   return MakeStack(box, box);
}

/// The upper body slides along x over the lower one, which is folded at its
/// middle.
class SlidingBodies
{
public:
   SlidingBodies()
      : mesh(MakeBodies()), spaces(mesh.Get(), 1),
        source(spaces, mesh.Boundary("upper_z0")),
        destination(spaces, mesh.Boundary("lower_z1")),
        areas(NodalAreas(destination)),
        gap(source, destination, areas, Options())
   {
   }

   void Move(real_t slide, real_t slope, real_t height = 0.01)
   {
      const Vector u = StackDisplacement(
         spaces,
         [=](const Vector &x, Vector &bend)
         {
            bend = 0.0;
            bend[2] = -slope * std::max<real_t>(0.0, x[0] - 0.5) * x[2];
         },
         [=](const Vector &, Vector &lift)
         {
            lift = 0.0;
            lift[0] = slide;
            lift[2] = height;
         });
      source.SetDisplacement(u);
      destination.SetDisplacement(u);
   }

   KeptBearing FindBearing(real_t slide, real_t slope)
   {
      Move(slide, slope);
      gap.Search();
      return gap.FindBearing(0.1);
   }

   /// How far the points of a search have slid when the upper body lies
   /// elsewhere then.
   real_t Slid(real_t from, real_t to, real_t height = 0.01)
   {
      Move(from, 0.0);
      gap.Search();
      CHECK(gap.Pairing().Slid() == 0.0);
      Move(to, 0.0, height);
      gap.Follow();
      return gap.Pairing().Slid();
   }

   /// What the vertices at @a x (undeformed) have of the multipliers' area, in
   /// all.
   real_t AreaAt(real_t x)
   {
      const Vector positions = NodePositions(spaces.Displacement());
      const Array<int> &dofs = destination.Vertices().TrueDofs();
      real_t area = 0.0;
      int found = 0;
      for (int j = 0; j < dofs.Size(); j++)
      {
         if (std::abs(positions[3 * dofs[j]] - x) < 1e-6)
         {
            area += gap.Operators().area[j];
            found++;
         }
      }
      CHECK(SumOverRanks(found, MPI_COMM_WORLD) == 2);
      return SumOverRanks(area, MPI_COMM_WORLD);
   }
   /// The same after a search with @a kept.
   real_t AreaAt(real_t x, real_t slide, real_t slope, const KeptBearing &kept)
   {
      Move(slide, slope);
      gap.Search(kept);
      return AreaAt(x);
   }

private:
   static GapOptions Options()
   {
      GapOptions options;
      options.search_radius = 1.0;
      options.rim_coverage = 0.4;
      return options;
   }

   NamedMesh mesh;
   BiphasicSpaces spaces;
   ContactSurface source;
   ContactSurface destination;
   Vector areas;
   FiniteGap gap;
};

/// Of the shape functions of the vertices at x = 0, on faces 0.25 long, the
/// area that the upper body covers.
real_t EndArea(real_t slide)
{
   return 0.125 * std::pow(1.0 - slide / 0.25, 2);
}
} // namespace

TEST_CASE("Vertices stay in or out of the rim within a step")
{
   // Of their area 46 and 36 % are covered, 4 and 92 % later on.
   const real_t more = 0.08;
   const real_t less = 0.1;
   const real_t sliver = 0.2;
   const real_t most = 0.01;
   SlidingBodies bodies;
   const auto covered = [](real_t slide)
   { return Approx(EndArea(slide)).epsilon(1e-10); };
   CHECK(bodies.AreaAt(0.0, more, 0.0, {}) == covered(more));
   CHECK(bodies.AreaAt(0.0, less, 0.0, {}) == 0.0);

   const KeptBearing outside = bodies.FindBearing(more, 0.0);
   CHECK(bodies.AreaAt(0.0, less, 0.0, outside) == covered(less));
   CHECK(bodies.AreaAt(0.0, sliver, 0.0, outside) == 0.0);

   const KeptBearing inside = bodies.FindBearing(less, 0.0);
   CHECK(bodies.AreaAt(0.0, more, 0.0, inside) == 0.0);
   CHECK(bodies.AreaAt(0.0, most, 0.0, inside) == covered(most));
}

TEST_CASE("Faces bear within a step what they bore at its start")
{
   SlidingBodies bodies;
   const real_t fold = 0.5;
   const KeptBearing flat = bodies.FindBearing(0.0, 0.0);
   const KeptBearing folded = bodies.FindBearing(0.0, 0.5);
   const real_t both_sides = 0.25;
   CHECK(bodies.AreaAt(fold, 0.0, 0.0, flat) ==
         Approx(both_sides).epsilon(1e-10));
   CHECK(bodies.AreaAt(fold, 0.0, 0.0, folded) ==
         Approx(0.5 * both_sides).epsilon(1e-10));
   CHECK(bodies.AreaAt(fold, 0.0, 0.5, flat) ==
         Approx(both_sides).epsilon(1e-10));
}

TEST_CASE("Points know how far they have slid since they were made")
{
   // The longer edges of a face, across x.
   const real_t size = 1.0;
   const auto part = [=](real_t slide)
   { return Approx(slide / size).epsilon(1e-10); };
   SlidingBodies bodies;
   CHECK(bodies.Slid(0.0, 0.05) == part(0.05));
   CHECK(bodies.Slid(0.3, 0.1) == part(0.2));
   CHECK(bodies.Slid(0.0, 0.3) == part(0.3));
   const real_t away = 2.0 * size;
   CHECK(bodies.Slid(0.0, 0.05, away) == infinity());
}
