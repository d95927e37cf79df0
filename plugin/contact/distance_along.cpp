#include "synovia/contact/distance_along.hpp"
#include "synovia/contact/surface_search.hpp"
#include "synovia/general/reduce.hpp"

#include <algorithm>
#include <limits>

namespace synovia
{

using namespace mfem;

namespace
{
// Faces turned away, or nearly so, meet nothing.
constexpr real_t facing_cosine = 0.2;
// Corners and points between them: enough to see a face of about their size.
constexpr int rays_order = 4;

void AddRays(const DeformedFace &face, const IntegrationRule &points,
             const Point3 &direction, std::vector<SearchQuery> &rays)
{
   for (int i = 0; i < points.GetNPoints(); i++)
   {
      const SurfacePoint at = face.Current(points.IntPoint(i));
      if (Dot(at.UnitNormal(), direction) > facing_cosine)
      {
         rays.push_back({at.position, direction});
      }
   }
}

real_t ShortestRay(const ContactSurface &from, const ContactSurface &to,
                   const Point3 &direction, real_t farthest)
{
   std::vector<SearchQuery> rays;
   for (const DeformedFace &face : from.Faces())
   {
      const Geometry::Type shape = face.GetGeometry();
      AddRays(face, *Geometries.GetVertices(shape), direction, rays);
      AddRays(face, IntRules.Get(shape, rays_order), direction, rays);
   }
   real_t shortest = std::numeric_limits<real_t>::infinity();
   for (const SearchHit &hit : SurfaceSearch(to, farthest).Find(rays))
   {
      if (hit.Found() && hit.distance >= 0.0)
      {
         shortest = std::min(shortest, hit.distance);
      }
   }
   return shortest;
}
} // namespace

real_t DistanceAlong(const ContactSurface &mover, const ContactSurface &other,
                     const Point3 &direction, real_t farthest)
{
   const Point3 back{-direction[0], -direction[1], -direction[2]};
   const real_t shortest =
      std::min(ShortestRay(mover, other, direction, farthest),
               ShortestRay(other, mover, back, farthest));
   return -MaxOverRanks(-shortest, mover.Spaces().GetComm());
}

} // namespace synovia
