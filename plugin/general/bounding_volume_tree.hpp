#pragma once

#include "synovia/general/point3.hpp"

#include <functional>
#include <vector>

namespace synovia
{

/// An axis-aligned box, empty until a point is added.
struct Box
{
   Box();
   bool Empty() const { return low[0] > high[0]; }
   void Add(const Point3 &point);
   void Add(const Box &box);
   void Inflate(mfem::real_t length);
   mfem::real_t LongestEdge() const;
   Point3 Center() const;
   /// Whether the segment from @a a to @a b meets the box.
   bool MeetsSegment(const Point3 &a, const Point3 &b) const;
   bool Meets(const Box &box) const;
   /// From a point to the nearest one of the box.
   mfem::real_t Distance(const Point3 &point) const;

   Point3 low;
   Point3 high;
};

/// A binary tree of bounding boxes over a fixed set of boxes, of which those
/// that are empty meet nothing.
class BoundingVolumeTree
{
public:
   explicit BoundingVolumeTree(const std::vector<Box> &boxes);

   /// Calls @a visit with the number of each box that meets the segment.
   void VisitSegment(const Point3 &a, const Point3 &b,
                     const std::function<void(int)> &visit) const;
   /// Likewise with each box that meets the @a box.
   void VisitBox(const Box &box, const std::function<void(int)> &visit) const;
   /// The least @a distance of what is in the boxes to a point; the first that
   /// is not above @a enough does.
   mfem::real_t
   LeastDistance(const Point3 &point, mfem::real_t enough,
                 const std::function<mfem::real_t(int)> &distance) const;

private:
   struct Node
   {
      Box box;
      int begin = 0;
      int end = 0;
      int left = -1;
      int right = -1;
   };

   int Build(const std::vector<Box> &boxes, int begin, int end);
   template <typename Meets>
   void Visit(Meets meets, const std::function<void(int)> &visit) const;

   std::vector<Node> nodes;
   std::vector<int> order;
   std::vector<Box> leaves;
};

} // namespace synovia
