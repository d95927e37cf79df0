// ranks: 1 2 3
//
// Centers of area and of circles, of an arc that leans.

#include "synovia/mesh/surface_center.hpp"
#include "support/boxes.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t radius = 3.0;
constexpr real_t inner = 2.0;
constexpr real_t turn = 0.6 * M_PI;
const Point3 center{{1.0, -2.0, 0.5}};
// An orthonormal frame: the arc turns about the last one.
const Point3 first{{0.8, 0.0, -0.6}};
const Point3 second{{0.0, 1.0, 0.0}};
const Point3 axis{{0.6, 0.0, 0.8}};

// Of MFEM's cartesian meshes: y = 0, y = 1, and z = 0.
constexpr int inside = 2;
constexpr int outside = 4;
constexpr int bottom = 1;

/// A part of a ring, from a box: x turns, y leads away from the axis.
std::unique_ptr<ParMesh> Arc(int pieces)
{
   Mesh box = Mesh::MakeCartesian3D(pieces, 2, 2, Element::HEXAHEDRON, 1.0, 1.0,
                                    1.0, false);
   box.Transform(
      [](const Vector &x, Vector &y)
      {
         const real_t angle = turn * x[0] * (0.5 + 0.5 * x[0]);
         const real_t r = inner + (radius - inner) * x[1];
         const Point3 place = Sum(Sum(Sum(center, r * std::cos(angle), first),
                                      r * std::sin(angle), second),
                                  x[2], axis);
         y.SetSize(3);
         std::copy(place.begin(), place.end(), y.GetData());
      });
   return std::make_unique<ParMesh>(MPI_COMM_WORLD, box);
}

real_t Distance(const Point3 &a, const Point3 &b)
{
   const Point3 difference = Sum(a, -1.0, b);
   return Length(difference);
}
} // namespace

TEST_CASE("The circle that fits an arc has its center")
{
   const int side = GENERATE(inside, outside);
   const Point3 middle = Sum(center, 0.5, axis);
   // Chords of one length leave the center where it is; these have several.
   real_t last = 0.0;
   for (const int pieces : {16, 32})
   {
      const std::unique_ptr<ParMesh> mesh = Arc(pieces);
      // The axis may have any length and sense.
      const real_t error = Distance(
         CenterOfCircle(*mesh, Array<int>({side}), Sum(axis, -3.0, axis)),
         middle);
      INFO("error " << error << " with " << pieces << " pieces");
      CHECK(error > 1e-8);
      CHECK(error < 1e-2);
      if (pieces > 16)
      {
         CHECK(error < 0.3 * last);
      }
      last = error;
   }
}

TEST_CASE("The center of area of an arc is that of the closed form")
{
   const std::unique_ptr<ParMesh> mesh = Arc(64);
   const real_t half = 0.5 * turn;
   const real_t distance = radius * std::sin(half) / half;
   const Point3 expected =
      Sum(Sum(Sum(center, distance * std::cos(half), first),
              distance * std::sin(half), second),
          0.5, axis);
   CHECK(Distance(CenterOfArea(*mesh, Array<int>({outside})), expected) < 1e-3);
}

TEST_CASE("What has no center says so")
{
   const std::unique_ptr<ParMesh> mesh = Arc(4);
   CHECK_THROWS_WITH(CenterOfArea(*mesh, Array<int>({77})),
                     Catch::Contains("without area"));
   CHECK_THROWS_WITH(CenterOfCircle(*mesh, Array<int>({77}), axis),
                     Catch::Contains("without area"));
   CHECK_THROWS_WITH(
      CenterOfCircle(*mesh, Array<int>({outside}), {{0.0, 0.0, 0.0}}),
      Catch::Contains("no direction"));
   // Seen along a tangent plane, the end of the arc is a straight line.
   Mesh box = Mesh::MakeCartesian3D(4, 4, 4, Element::HEXAHEDRON);
   ParMesh straight(MPI_COMM_WORLD, box);
   CHECK_THROWS_WITH(
      CenterOfCircle(straight, Array<int>({bottom}), {{1.0, 0.0, 0.0}}),
      Catch::Contains("straight"));
}
