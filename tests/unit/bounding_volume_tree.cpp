// ranks: 1 2
//
// The tree of boxes against brute force.

#include "synovia/general/bounding_volume_tree.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>
#include <set>

using namespace mfem;
using namespace synovia;

namespace
{
class Random
{
public:
   explicit Random(int seed) : engine(seed) {}
   real_t operator()(real_t low, real_t high)
   {
      return std::uniform_real_distribution<real_t>(low, high)(engine);
   }
   Point3 Point() { return {(*this)(0, 1), (*this)(0, 1), (*this)(0, 1)}; }
   Box MakeBox(real_t size)
   {
      const Point3 a = Point();
      Box box;
      box.Add(a);
      // Some boxes are flat.
      const bool flat = (*this)(0, 1) < 0.3;
      box.Add({a[0] + (*this)(0, size), a[1] + (*this)(0, size),
               flat ? a[2] : a[2] + (*this)(0, size)});
      return box;
   }

private:
   std::mt19937 engine;
};

// How far a segment stays from a box, in the maximum norm, by ternary search:
// the distance is convex along the segment.
real_t Distance(const Box &box, const Point3 &a, const Point3 &b)
{
   const auto at = [&](real_t s)
   {
      real_t farthest = 0.0;
      for (int d = 0; d < 3; d++)
      {
         const real_t x = a[d] + s * (b[d] - a[d]);
         farthest = std::max({farthest, box.low[d] - x, x - box.high[d]});
      }
      return farthest;
   };
   real_t low = 0.0;
   real_t high = 1.0;
   for (int i = 0; i < 100; i++)
   {
      const real_t s = low + (high - low) / 3.0;
      const real_t t = high - (high - low) / 3.0;
      (at(s) < at(t) ? high : low) = at(s) < at(t) ? t : s;
   }
   return std::min({at(0.0), at(1.0), at(0.5 * (low + high))});
}

std::multiset<int> Visited(const BoundingVolumeTree &tree, const Point3 &a,
                           const Point3 &b)
{
   std::multiset<int> visited;
   tree.VisitSegment(a, b, [&](int i) { visited.insert(i); });
   return visited;
}
} // namespace

TEST_CASE("A segment meets a box where its distance from it is nil")
{
   Random random(1);
   int met = 0;
   for (int i = 0; i < 2000; i++)
   {
      const Box box = random.MakeBox(0.5);
      const Point3 a = random.Point();
      const Point3 b = random.Point();
      const real_t distance = Distance(box, a, b);
      // In between, the search may not have got there.
      if (distance == 0.0 || distance > 1e-6)
      {
         CHECK(box.MeetsSegment(a, b) == (distance == 0.0));
         CHECK(box.MeetsSegment(b, a) == (distance == 0.0));
      }
      met += box.MeetsSegment(a, b);
   }
   CHECK(met > 50);
   CHECK(met < 1950);
}

TEST_CASE("Segments along the axes and in the faces of a box meet it")
{
   Box box;
   CHECK(box.Empty());
   box.Add({0.0, 0.0, 0.0});
   box.Add({1.0, 1.0, 1.0});
   CHECK_FALSE(box.Empty());
   CHECK(box.MeetsSegment({0.5, 0.5, -1.0}, {0.5, 0.5, 2.0}));
   CHECK(box.MeetsSegment({0.5, 0.5, 0.2}, {0.5, 0.5, 0.3}));
   CHECK(box.MeetsSegment({1.0, -1.0, 1.0}, {1.0, 2.0, 1.0}));
   CHECK(box.MeetsSegment({0.5, 0.5, -1.0}, {0.5, 0.5, 0.0}));
   CHECK(box.MeetsSegment({0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}));
   CHECK_FALSE(box.MeetsSegment({0.5, 0.5, -1.0}, {0.5, 0.5, -0.1}));
   CHECK_FALSE(box.MeetsSegment({1.5, 0.5, -1.0}, {1.5, 0.5, 2.0}));
   CHECK_FALSE(box.MeetsSegment({2.5, 0.0, 0.0}, {0.0, 0.0, 2.5}));
}

TEST_CASE("Two boxes meet where they overlap or touch")
{
   Box box;
   box.Add({0.0, 0.0, 0.0});
   box.Add({1.0, 1.0, 1.0});
   const auto at = [](real_t x, real_t y, real_t z)
   {
      Box other;
      other.Add({x, y, z});
      other.Add({x + 0.5, y + 0.5, z + 0.5});
      return other;
   };
   CHECK(box.Meets(at(0.2, 0.2, 0.2)));
   CHECK(box.Meets(at(1.0, -0.5, 0.9)));
   CHECK_FALSE(box.Meets(at(1.1, 0.2, 0.2)));
   CHECK_FALSE(box.Meets(at(0.2, -0.6, 0.2)));
   CHECK_FALSE(box.Meets(at(0.2, 0.2, 1.01)));
   CHECK_FALSE(box.Meets(Box()));
   CHECK_FALSE(Box().Meets(box));
}

TEST_CASE("The tree visits the boxes that brute force finds, each once")
{
   const int count = GENERATE(0, 1, 4, 5, 8, 100, 1000);
   const real_t size = GENERATE(0.02, 0.3);
   CAPTURE(count, size);
   Random random(count + 7);
   std::vector<Box> boxes;
   for (int i = 0; i < count; i++)
   {
      boxes.push_back(random.MakeBox(size));
   }
   const BoundingVolumeTree tree(boxes);
   int found = 0;
   for (int i = 0; i < 200; i++)
   {
      const Point3 a = random.Point();
      Point3 b = random.Point();
      // Short ones, long ones, and along an axis.
      const real_t length = i % 3 == 0 ? 1.0 : 0.05;
      for (int d = 0; d < 3; d++)
      {
         b[d] = i % 5 == 0 && d < 2 ? a[d] : a[d] + length * (b[d] - a[d]);
      }
      std::multiset<int> wanted;
      for (int k = 0; k < count; k++)
      {
         if (boxes[k].MeetsSegment(a, b))
         {
            wanted.insert(k);
         }
      }
      CHECK(Visited(tree, a, b) == wanted);
      const Box window = random.MakeBox(0.2);
      std::multiset<int> met;
      for (int k = 0; k < count; k++)
      {
         if (boxes[k].Meets(window))
         {
            met.insert(k);
         }
      }
      std::multiset<int> visited;
      tree.VisitBox(window, [&](int k) { visited.insert(k); });
      CHECK(visited == met);
      found += static_cast<int>(wanted.size());
   }
   CHECK((count < 1000 || found > 0));
}

TEST_CASE("Boxes that are all the same don't make the tree degenerate")
{
   Box box;
   box.Add({0.0, 0.0, 0.0});
   box.Add({1.0, 1.0, 1.0});
   const BoundingVolumeTree tree(std::vector<Box>(1000, box));
   CHECK(Visited(tree, {0.5, 0.5, -1.0}, {0.5, 0.5, 2.0}).size() == 1000);
   CHECK(Visited(tree, {0.5, 2.5, -1.0}, {0.5, 2.5, 2.0}).empty());
}

TEST_CASE("Empty boxes among others meet nothing")
{
   Box box;
   box.Add({0.0, 0.0, 0.0});
   box.Add({1.0, 1.0, 1.0});
   std::vector<Box> boxes(10);
   boxes[3] = boxes[7] = box;
   const BoundingVolumeTree tree(boxes);
   const std::multiset<int> wanted{3, 7};
   CHECK(Visited(tree, {0.5, 0.5, -1.0}, {0.5, 0.5, 2.0}) == wanted);
   std::multiset<int> visited;
   tree.VisitBox(box, [&](int i) { visited.insert(i); });
   CHECK(visited == wanted);
   const BoundingVolumeTree none(std::vector<Box>(10));
   CHECK(Visited(none, {0.5, 0.5, -1.0}, {0.5, 0.5, 2.0}).empty());
}
