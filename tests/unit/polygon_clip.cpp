// ranks: 1
//
// Triangles of a random tiling of the plane, clipped to a reference face: the
// pieces tile the face, and their rules add up to integrals over it.

#include "synovia/contact/polygon_clip.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t round_off = 1e-13;

// A grid of n x n cells from -1 to 2, its inner vertices moved at random, each
// cell cut in two.
std::vector<Polygon> Tiling(int n, int seed)
{
   std::mt19937 engine(seed);
   std::uniform_real_distribution<real_t> random(-0.3, 0.3);
   const real_t h = 3.0 / n;
   std::vector<Point2> vertices;
   for (int j = 0; j <= n; j++)
   {
      for (int i = 0; i <= n; i++)
      {
         const bool inner = i > 0 && i < n && j > 0 && j < n;
         vertices.push_back({-1 + h * (i + (inner ? random(engine) : 0.0)),
                             -1 + h * (j + (inner ? random(engine) : 0.0))});
      }
   }
   std::vector<Polygon> tiles;
   for (int j = 0; j < n; j++)
   {
      for (int i = 0; i < n; i++)
      {
         const auto at = [&](int a, int b)
         { return vertices[(j + b) * (n + 1) + i + a]; };
         tiles.push_back({at(0, 0), at(1, 0), at(1, 1)});
         tiles.push_back({at(0, 0), at(1, 1), at(0, 1)});
      }
   }
   return tiles;
}

real_t Area(Geometry::Type geometry)
{
   return geometry == Geometry::TRIANGLE ? 0.5 : 1.0;
}

// Of x^a y^b over the reference face.
real_t Integral(Geometry::Type geometry, int a, int b)
{
   if (geometry == Geometry::SQUARE)
   {
      return 1.0 / ((a + 1) * (b + 1));
   }
   return std::tgamma(a + 1) * std::tgamma(b + 1) / std::tgamma(a + b + 3);
}
} // namespace

TEST_CASE("Pieces of a tiling tile the face")
{
   const auto geometry = GENERATE(Geometry::TRIANGLE, Geometry::SQUARE);
   const int cells = GENERATE(1, 2, 5, 17);
   std::vector<IntegrationPoint> points;
   real_t area = 0.0;
   for (const Polygon &tile : Tiling(cells, 3 * cells))
   {
      const Polygon piece = ClipToReference(tile, geometry);
      CHECK(SignedArea(piece) >= 0.0);
      area += SignedArea(piece);
      AppendRule(piece, 5, points);
   }
   CHECK(area == Approx(Area(geometry)).epsilon(round_off));
   for (int a = 0; a <= 5; a++)
   {
      for (int b = 0; a + b <= 5; b++)
      {
         CAPTURE(a, b);
         real_t sum = 0.0;
         for (const IntegrationPoint &ip : points)
         {
            sum += ip.weight * std::pow(ip.x, a) * std::pow(ip.y, b);
         }
         CHECK(sum == Approx(Integral(geometry, a, b)).epsilon(1e-12));
      }
   }
}

TEST_CASE("Polygons that miss, contain or equal the face")
{
   const auto geometry = GENERATE(Geometry::TRIANGLE, Geometry::SQUARE);
   const Polygon beside = {{1.5, 0.0}, {3.0, 0.0}, {3.0, 2.0}};
   CHECK(ClipToReference(beside, geometry).empty());
   const Polygon around = {{-5, -5}, {5, -5}, {5, 5}, {-5, 5}};
   CHECK(SignedArea(ClipToReference(around, geometry)) ==
         Approx(Area(geometry)));
   Polygon clockwise(around.rbegin(), around.rend());
   CHECK(SignedArea(ClipToReference(clockwise, geometry)) ==
         Approx(-Area(geometry)));
   const Polygon same = {{0, 0}, {1, 0}, {0, 1}};
   CHECK(SignedArea(ClipToReference(same, geometry)) == Approx(0.5));
}

TEST_CASE("A polygon with a dent loses the dent's area")
{
   // The unit square with a corner of its upper edge pulled down to (0.5, 0.6).
   const Polygon dented = {{0, 0}, {1, 0}, {1, 1}, {0.5, 0.6}, {0, 1}};
   std::vector<IntegrationPoint> points;
   AppendRule(ClipToReference(dented, Geometry::SQUARE), 2, points);
   real_t area = 0.0;
   real_t moment = 0.0;
   for (const IntegrationPoint &ip : points)
   {
      area += ip.weight;
      moment += ip.weight * ip.y;
   }
   // Less the triangle of base 1, height 0.4 and centroid at 13/15.
   CHECK(area == Approx(0.8));
   CHECK(moment == Approx(0.5 - 0.2 * 13.0 / 15.0));
}
