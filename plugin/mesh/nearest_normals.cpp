#include "synovia/mesh/nearest_normals.hpp"

#include <cmath>
#include <map>

namespace synovia
{

using namespace mfem;

namespace
{
// Corners that are nearer than this part of the surface's size are one vertex.
constexpr real_t same_place = 1e-7;

using Place = std::array<long long, 3>;

Place PlaceOf(const Point3 &corner, real_t unit)
{
   return {std::llround(corner[0] / unit), std::llround(corner[1] / unit),
           std::llround(corner[2] / unit)};
}

Point3 Unit(const Point3 &a)
{
   return Sum({0.0, 0.0, 0.0}, 1.0 / Length(a), a);
}
} // namespace

NearestNormals::NearestNormals(ParMesh &mesh, const Array<int> &boundaries)
   : surface(mesh, [&](int element)
             { return boundaries.Find(mesh.GetBdrAttribute(element)) >= 0; })
{
   MFEM_VERIFY(!surface.Empty(), "a surface without faces has no normals");
   const real_t unit = same_place * surface.Size();
   std::map<Place, Point3> sums;
   for (const Triangle &triangle : surface.Triangles())
   {
      for (const Point3 &corner : triangle)
      {
         Point3 &sum = sums[PlaceOf(corner, unit)];
         sum = Sum(sum, 1.0, AreaVector(triangle));
      }
   }
   for (const Triangle &triangle : surface.Triangles())
   {
      Triangle corners;
      for (int i = 0; i < 3; i++)
      {
         const Point3 &sum = sums[PlaceOf(triangle[i], unit)];
         corners[i] = Length(sum) > 0.0 ? Unit(sum) : AreaVector(triangle);
      }
      normals.push_back(corners);
   }
}

Point3 NearestNormals::operator()(const Point3 &point) const
{
   const TriangulatedSurface::Foot foot = surface.FindFoot(point);
   return Unit(Interpolate(normals[foot.triangle], foot.weights));
}

} // namespace synovia
