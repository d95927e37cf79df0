#include "synovia/contact/polygon_clip.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
/// The half-plane a x + b y <= c.
struct HalfPlane
{
   real_t a;
   real_t b;
   real_t c;

   real_t Outside(const Point2 &p) const { return a * p[0] + b * p[1] - c; }
};

const std::vector<HalfPlane> &Sides(Geometry::Type geometry)
{
   static const std::vector<HalfPlane> triangle = {
      {-1, 0, 0}, {0, -1, 0}, {1, 1, 1}};
   static const std::vector<HalfPlane> square = {
      {-1, 0, 0}, {0, -1, 0}, {1, 0, 1}, {0, 1, 1}};
   return geometry == Geometry::TRIANGLE ? triangle : square;
}

real_t TwiceArea(const Point2 &a, const Point2 &b, const Point2 &c)
{
   return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

Polygon Clip(const Polygon &polygon, const HalfPlane &half)
{
   Polygon inside;
   inside.reserve(polygon.size() + 2);
   for (size_t i = 0; i < polygon.size(); i++)
   {
      const Point2 &a = polygon[i];
      const Point2 &b = polygon[(i + 1) % polygon.size()];
      const real_t at_a = half.Outside(a);
      const real_t at_b = half.Outside(b);
      if (at_a <= 0.0)
      {
         inside.push_back(a);
      }
      if ((at_a < 0.0 && at_b > 0.0) || (at_a > 0.0 && at_b < 0.0))
      {
         const real_t s = at_a / (at_a - at_b);
         inside.push_back({a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])});
      }
   }
   return inside;
}

void AppendTriangle(const Point2 &a, const Point2 &b, const Point2 &c,
                    int order, std::vector<IntegrationPoint> &points)
{
   const real_t jacobian = TwiceArea(a, b, c);
   if (jacobian == 0.0)
   {
      return;
   }
   const IntegrationRule &rule = IntRules.Get(Geometry::TRIANGLE, order);
   for (int q = 0; q < rule.GetNPoints(); q++)
   {
      const IntegrationPoint &ip = rule.IntPoint(q);
      const real_t r = 1.0 - ip.x - ip.y;
      IntegrationPoint point;
      point.Set2w(r * a[0] + ip.x * b[0] + ip.y * c[0],
                  r * a[1] + ip.x * b[1] + ip.y * c[1], ip.weight * jacobian);
      points.push_back(point);
   }
}
} // namespace

Polygon ClipToReference(const Polygon &polygon, Geometry::Type geometry)
{
   Polygon clipped = polygon;
   for (const HalfPlane &side : Sides(geometry))
   {
      clipped = Clip(clipped, side);
      if (clipped.size() < 3)
      {
         return {};
      }
   }
   return clipped;
}

real_t SignedArea(const Polygon &polygon)
{
   real_t area = 0.0;
   for (size_t i = 2; i < polygon.size(); i++)
   {
      area += 0.5 * TwiceArea(polygon[0], polygon[i - 1], polygon[i]);
   }
   return area;
}

void AppendRule(const Polygon &polygon, int order,
                std::vector<IntegrationPoint> &points)
{
   for (size_t i = 2; i < polygon.size(); i++)
   {
      AppendTriangle(polygon[0], polygon[i - 1], polygon[i], order, points);
   }
}

} // namespace synovia
