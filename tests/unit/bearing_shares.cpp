// ranks: 1 2 3
//
// A surface with a fold below a flat one: the gap of the vertices on the fold
// is that of the side that may touch, whatever the other one sees. A flat
// surface bears all, whatever the other one does.

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
constexpr real_t fold = 0.5;
constexpr real_t slope = 0.5;
constexpr real_t distance = 0.01;
// Less than half of the angle of the fold, more than that, and any.
constexpr real_t narrow = 0.1;
constexpr real_t middling = 0.3;
constexpr real_t any = 1e3;

/// What the vertices on the fold have, each of which is on a rim of the surface
/// besides.
struct FoldValues
{
   int vertices = 0;
   real_t smallest_gap = infinity();
   real_t largest_gap = 0.0;
   real_t area = 0.0;
};

NamedMesh MakeBodies(int upper_faces)
{
   BoxOptions lower;
   lower.nx = 2;
   lower.nz = 1;
   BoxOptions upper = lower;
   upper.nx = upper_faces;
   upper.size_x = 0.25 * upper_faces;
   return MakeStack(lower, upper);
}

/// With an upper body of faces that are 0.25 long.
FoldValues FindFoldValues(int upper_faces, real_t bearing_angle,
                          const std::string &folded = "destination")
{
   NamedMesh mesh = MakeBodies(upper_faces);
   BiphasicSpaces spaces(mesh.Get(), 1);
   const bool below = folded == "destination";
   ContactSurface source(spaces,
                         mesh.Boundary(below ? "upper_z0" : "lower_z1"));
   ContactSurface destination(spaces,
                              mesh.Boundary(below ? "lower_z1" : "upper_z0"));

   const Vector u = StackDisplacement(
      spaces,
      [](const Vector &x, Vector &bend)
      {
         bend = 0.0;
         bend[2] = -slope * std::max<real_t>(0.0, x[0] - fold) * x[2];
      },
      [](const Vector &, Vector &lift)
      {
         lift = 0.0;
         lift[2] = distance;
      });
   source.SetDisplacement(u);
   destination.SetDisplacement(u);

   GapOptions options;
   options.search_radius = 1.0;
   const Vector areas = NodalAreas(destination);
   FiniteGap gap(source, destination, areas, options);
   gap.Search();
   gap.Search(gap.FindBearing(bearing_angle));

   FoldValues values;
   const Vector positions = NodePositions(spaces.Displacement());
   const Array<int> &dofs = destination.Vertices().TrueDofs();
   for (int j = 0; j < dofs.Size(); j++)
   {
      if (std::abs(positions[3 * dofs[j]] - fold) < 1e-6)
      {
         values.vertices++;
         values.smallest_gap = std::min(values.smallest_gap, gap.Gap()[j]);
         values.largest_gap = std::max(values.largest_gap, gap.Gap()[j]);
         values.area += gap.Operators().area[j];
      }
   }
   values.vertices = SumOverRanks(values.vertices, MPI_COMM_WORLD);
   values.smallest_gap = -MaxOverRanks(-values.smallest_gap, MPI_COMM_WORLD);
   values.largest_gap = MaxOverRanks(values.largest_gap, MPI_COMM_WORLD);
   values.area = SumOverRanks(values.area, MPI_COMM_WORLD);
   return values;
}
} // namespace

TEST_CASE("The gap at a fold is that of the side that may touch")
{
   const FoldValues one_side = FindFoldValues(4, narrow);
   REQUIRE(one_side.vertices == 2);
   // Normals at the fold are tilted by half its angle.
   CHECK(one_side.smallest_gap > distance);
   CHECK(one_side.largest_gap < distance / std::cos(0.5 * std::atan(slope)));
   // Of both vertices, on a flat side of 0.5 x 1.
   CHECK(one_side.area == Approx(0.25).epsilon(1e-10));
   // The mean over both sides, one of which is linear: about slope x length / 6
   // more.
   const FoldValues both = FindFoldValues(4, any);
   CHECK(both.smallest_gap > distance + 0.8 * slope * fold / 6.0);
   CHECK(both.area > 1.9 * one_side.area);
   // Part of the other side.
   const FoldValues part = FindFoldValues(4, middling);
   CHECK(part.area > 1.2 * one_side.area);
   CHECK(part.area < 0.9 * both.area);
}

TEST_CASE("The gap at a fold does not depend on how far the source reaches")
{
   const FoldValues longer = FindFoldValues(4, narrow);
   const FoldValues shorter = FindFoldValues(3, narrow);
   REQUIRE(shorter.vertices == 2);
   CHECK(shorter.largest_gap == Approx(longer.largest_gap).epsilon(1e-10));
   CHECK(shorter.area == Approx(longer.area).epsilon(1e-10));
   CHECK(std::abs(FindFoldValues(3, any).largest_gap -
                  FindFoldValues(4, any).largest_gap) > 0.1 * distance);
}

TEST_CASE("Below a fold of the source a flat surface bears all")
{
   const FoldValues all = FindFoldValues(4, any, "source");
   const FoldValues folded = FindFoldValues(4, narrow, "source");
   REQUIRE(folded.vertices == 2);
   CHECK(all.area == Approx(0.25).epsilon(0.3));
   CHECK(folded.area == Approx(all.area).epsilon(1e-12));
   CHECK(folded.largest_gap == Approx(all.largest_gap).epsilon(1e-12));
}
