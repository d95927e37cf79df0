#pragma once

#include "synovia/general/bounding_volume_tree.hpp"

#include <array>
#include <functional>
#include <vector>

namespace synovia
{

/// Three corners, counter-clockwise as seen from outside.
using Triangle = std::array<Point3, 3>;

/// Barycentric coordinates of a point of a triangle.
using TriangleWeights = std::array<mfem::real_t, 3>;

inline Point3 Interpolate(const Triangle &t, const TriangleWeights &weights)
{
   Point3 sum{{0.0, 0.0, 0.0}};
   for (int i = 0; i < 3; i++)
   {
      sum = Sum(sum, weights[i], t[i]);
   }
   return sum;
}

/// Along the outward normal, twice as long as the area.
inline Point3 AreaVector(const Triangle &t)
{
   return Cross(Sum(t[1], -1.0, t[0]), Sum(t[2], -1.0, t[0]));
}

/// Faces of the boundary as flat triangles, all of them on every rank: for
/// questions about the shape of a body. A curved face is several of them.
class TriangulatedSurface
{
public:
   /// Takes the boundary elements of this rank that @a picked says. Collective.
   TriangulatedSurface(mfem::ParMesh &mesh,
                       const std::function<bool(int)> &picked);

   bool Empty() const { return triangles.empty(); }
   const std::vector<Triangle> &Triangles() const { return triangles; }
   /// The diagonal of a box around all of it.
   mfem::real_t Size() const { return size; }

   /// Where a surface is nearest to a point.
   struct Foot
   {
      int triangle = -1;
      TriangleWeights weights{{0.0, 0.0, 0.0}};
   };
   /// Of the surface, which must not be empty.
   Foot FindFoot(const Point3 &point) const;

   /// From a point to the nearest one of the surface, or anything between that
   /// and @a enough if it isn't farther.
   mfem::real_t Distance(const Point3 &point, mfem::real_t enough) const;

   /// How far a ray goes, from a point on the surface along a unit vector,
   /// until it leaves the body; infinity if it doesn't.
   mfem::real_t WayThrough(const Point3 &from, const Point3 &along) const;

private:
   std::vector<Triangle> triangles;
   BoundingVolumeTree tree;
   mfem::real_t size = 0.0;
};

/// The triangles that stand for a boundary element of this rank.
std::vector<Triangle> Triangulate(mfem::ParMesh &mesh, int boundary_element);

} // namespace synovia
