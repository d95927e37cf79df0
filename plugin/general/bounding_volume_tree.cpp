#include "synovia/general/bounding_volume_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace synovia
{

using namespace mfem;

namespace
{
constexpr int leaf_size = 4;
}

Box::Box()
{
   low.fill(std::numeric_limits<real_t>::max());
   high.fill(std::numeric_limits<real_t>::lowest());
}

void Box::Add(const Point3 &point)
{
   for (int d = 0; d < 3; d++)
   {
      low[d] = std::min(low[d], point[d]);
      high[d] = std::max(high[d], point[d]);
   }
}

void Box::Add(const Box &box)
{
   if (!box.Empty())
   {
      Add(box.low);
      Add(box.high);
   }
}

void Box::Inflate(real_t length)
{
   for (int d = 0; d < 3; d++)
   {
      low[d] -= length;
      high[d] += length;
   }
}

real_t Box::LongestEdge() const
{
   real_t longest = 0.0;
   for (int d = 0; d < 3; d++)
   {
      longest = std::max(longest, high[d] - low[d]);
   }
   return longest;
}

Point3 Box::Center() const
{
   Point3 center;
   for (int d = 0; d < 3; d++)
   {
      center[d] = 0.5 * (low[d] + high[d]);
   }
   return center;
}

bool Box::MeetsSegment(const Point3 &a, const Point3 &b) const
{
   real_t enter = 0.0;
   real_t leave = 1.0;
   for (int d = 0; d < 3; d++)
   {
      const real_t slope = b[d] - a[d];
      if (slope == 0.0)
      {
         if (a[d] < low[d] || a[d] > high[d])
         {
            return false;
         }
         continue;
      }
      const real_t s = (low[d] - a[d]) / slope;
      const real_t t = (high[d] - a[d]) / slope;
      enter = std::max(enter, std::min(s, t));
      leave = std::min(leave, std::max(s, t));
      if (enter > leave)
      {
         return false;
      }
   }
   return true;
}

bool Box::Meets(const Box &box) const
{
   for (int d = 0; d < 3; d++)
   {
      if (low[d] > box.high[d] || high[d] < box.low[d])
      {
         return false;
      }
   }
   return true;
}

real_t Box::Distance(const Point3 &point) const
{
   Point3 away;
   for (int d = 0; d < 3; d++)
   {
      away[d] = std::max({low[d] - point[d], point[d] - high[d], real_t(0.0)});
   }
   return Length(away);
}

BoundingVolumeTree::BoundingVolumeTree(const std::vector<Box> &boxes)
{
   for (size_t i = 0; i < boxes.size(); i++)
   {
      if (!boxes[i].Empty())
      {
         order.push_back(static_cast<int>(i));
      }
   }
   nodes.reserve(2 * order.size() / leaf_size + 2);
   if (!order.empty())
   {
      Build(boxes, 0, static_cast<int>(order.size()));
   }
   leaves.reserve(order.size());
   for (const int i : order)
   {
      leaves.push_back(boxes[i]);
   }
}

int BoundingVolumeTree::Build(const std::vector<Box> &boxes, int begin, int end)
{
   const int index = static_cast<int>(nodes.size());
   nodes.emplace_back();
   Node node;
   node.begin = begin;
   node.end = end;
   Box centers;
   for (int i = begin; i < end; i++)
   {
      node.box.Add(boxes[order[i]]);
      centers.Add(boxes[order[i]].Center());
   }
   if (end - begin > leaf_size)
   {
      int axis = 0;
      for (int d = 1; d < 3; d++)
      {
         if (centers.high[d] - centers.low[d] >
             centers.high[axis] - centers.low[axis])
         {
            axis = d;
         }
      }
      const int middle = begin + (end - begin) / 2;
      std::nth_element(order.begin() + begin, order.begin() + middle,
                       order.begin() + end,
                       [&](int i, int j)
                       {
                          const real_t x = boxes[i].Center()[axis];
                          const real_t y = boxes[j].Center()[axis];
                          return x < y || (x == y && i < j);
                       });
      node.left = Build(boxes, begin, middle);
      node.right = Build(boxes, middle, end);
   }
   nodes[index] = node;
   return index;
}

template <typename Meets>
void BoundingVolumeTree::Visit(Meets meets,
                               const std::function<void(int)> &visit) const
{
   if (nodes.empty())
   {
      return;
   }
   // Halving the boxes bounds the depth by the bits of an int, and each level
   // leaves at most one box waiting.
   std::array<int, 64> stack;
   int top = 0;
   stack[top++] = 0;
   while (top > 0)
   {
      const Node &node = nodes[stack[--top]];
      if (!meets(node.box))
      {
         continue;
      }
      if (node.left >= 0)
      {
         stack[top++] = node.left;
         stack[top++] = node.right;
         continue;
      }
      for (int i = node.begin; i < node.end; i++)
      {
         if (meets(leaves[i]))
         {
            visit(order[i]);
         }
      }
   }
}

void BoundingVolumeTree::VisitSegment(
   const Point3 &a, const Point3 &b,
   const std::function<void(int)> &visit) const
{
   Visit([&](const Box &box) { return box.MeetsSegment(a, b); }, visit);
}

void BoundingVolumeTree::VisitBox(const Box &box,
                                  const std::function<void(int)> &visit) const
{
   Visit([&](const Box &candidate) { return candidate.Meets(box); }, visit);
}

real_t BoundingVolumeTree::LeastDistance(
   const Point3 &point, real_t enough,
   const std::function<real_t(int)> &distance) const
{
   real_t least = std::numeric_limits<real_t>::infinity();
   if (nodes.empty())
   {
      return least;
   }
   // The nearer half of a box comes first.
   std::array<int, 64> stack;
   int top = 0;
   stack[top++] = 0;
   while (top > 0 && least > enough)
   {
      const Node &node = nodes[stack[--top]];
      if (node.box.Distance(point) >= least)
      {
         continue;
      }
      if (node.left >= 0)
      {
         const bool left_first = nodes[node.left].box.Distance(point) <
                                 nodes[node.right].box.Distance(point);
         stack[top++] = left_first ? node.right : node.left;
         stack[top++] = left_first ? node.left : node.right;
         continue;
      }
      for (int i = node.begin; i < node.end; i++)
      {
         if (leaves[i].Distance(point) < least)
         {
            least = std::min(least, distance(order[i]));
         }
      }
   }
   return least;
}

} // namespace synovia
