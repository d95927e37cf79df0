#include "synovia/contact/point_range.hpp"

#include <algorithm>

namespace synovia
{

namespace
{
template <typename Alike>
std::vector<PointRange> Group(const PairedPoint *begin, const PairedPoint *end,
                              const Alike &alike)
{
   std::vector<PointRange> groups;
   while (begin != end)
   {
      const PairedPoint &first = *begin;
      const PairedPoint *const next = std::find_if_not(
         begin, end,
         [&](const PairedPoint &point) { return alike(first, point); });
      groups.emplace_back(begin, next);
      begin = next;
   }
   return groups;
}

bool OnOneFace(const PairedPoint &a, const PairedPoint &b)
{
   return a.face == b.face;
}

bool HitOneFace(const PairedPoint &a, const PairedPoint &b)
{
   return a.source == b.source;
}
} // namespace

std::vector<PointRange> GroupByFace(const std::vector<PairedPoint> &points)
{
   return Group(points.data(), points.data() + points.size(), OnOneFace);
}

std::vector<PointRange> GroupBySource(const PointRange &face_points)
{
   return Group(face_points.begin(), face_points.end(), HitOneFace);
}

std::vector<PointRange> GroupByFacePair(const std::vector<PairedPoint> &points)
{
   return Group(points.data(), points.data() + points.size(),
                [](const PairedPoint &a, const PairedPoint &b)
                { return OnOneFace(a, b) && HitOneFace(a, b); });
}

} // namespace synovia
