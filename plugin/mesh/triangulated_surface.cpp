#include "synovia/mesh/triangulated_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace synovia
{

using namespace mfem;

namespace
{
// A ray leaves the body where it meets the surface at less than 80 degrees from
// its normal, and by more than this part of the surface's size from its start.
constexpr real_t least_cosine = 0.17;
constexpr real_t starts_beyond = 1e-6;

Point3 Difference(const Point3 &a, const Point3 &b)
{
   return Sum(a, -1.0, b);
}

// How far along a segment it is nearest to a point, from 0 to 1.
real_t NearestPart(const Point3 &x, const Point3 &a, const Point3 &b)
{
   const Point3 edge = Difference(b, a);
   const real_t square = Dot(edge, edge);
   const real_t s = square > 0.0 ? Dot(Difference(x, a), edge) / square : 0.0;
   return std::min(std::max(s, real_t(0.0)), real_t(1.0));
}

// Barycentric coordinates of a point's projection on the plane of a triangle.
TriangleWeights Coordinates(const Point3 &x, const Triangle &t,
                            const Point3 &area)
{
   const real_t square = Dot(area, area);
   TriangleWeights weights;
   for (int i = 0; i < 3; i++)
   {
      const Point3 &b = t[(i + 1) % 3];
      const Point3 &c = t[(i + 2) % 3];
      weights[i] =
         Dot(Cross(Difference(b, x), Difference(c, x)), area) / square;
   }
   return weights;
}

bool IsInside(const TriangleWeights &weights)
{
   constexpr real_t tolerance = 1e-9;
   return std::all_of(weights.begin(), weights.end(),
                      [](real_t weight) { return weight >= -tolerance; });
}

// Of the point of a triangle that is nearest to x.
TriangleWeights NearestWeights(const Point3 &x, const Triangle &t)
{
   const Point3 area = AreaVector(t);
   if (Length(area) > 0.0)
   {
      const TriangleWeights weights = Coordinates(x, t, area);
      if (IsInside(weights))
      {
         return weights;
      }
   }
   TriangleWeights nearest{};
   real_t least = std::numeric_limits<real_t>::infinity();
   for (int i = 0; i < 3; i++)
   {
      const int j = (i + 1) % 3;
      TriangleWeights weights{{0.0, 0.0, 0.0}};
      weights[j] = NearestPart(x, t[i], t[j]);
      weights[i] = 1.0 - weights[j];
      const real_t distance = Length(Difference(x, Interpolate(t, weights)));
      if (distance < least)
      {
         least = distance;
         nearest = weights;
      }
   }
   return nearest;
}

real_t DistanceToTriangle(const Point3 &x, const Triangle &t)
{
   return Length(Difference(x, Interpolate(t, NearestWeights(x, t))));
}

std::vector<Triangle> OnAllRanks(const std::vector<Triangle> &mine,
                                 MPI_Comm comm)
{
   int ranks = 1;
   MPI_Comm_size(comm, &ranks);
   const int count = 9 * static_cast<int>(mine.size());
   std::vector<int> counts(ranks);
   MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, comm);
   std::vector<int> first(ranks, 0);
   for (int r = 1; r < ranks; r++)
   {
      first[r] = first[r - 1] + counts[r - 1];
   }
   std::vector<Triangle> all((first.back() + counts.back()) / 9);
   const MPI_Datatype real = MPITypeMap<real_t>::mpi_type;
   MPI_Allgatherv(mine.data(), count, real, all.data(), counts.data(),
                  first.data(), real, comm);
   return all;
}

std::vector<Box> BoxesOf(const std::vector<Triangle> &triangles)
{
   std::vector<Box> boxes(triangles.size());
   for (size_t i = 0; i < triangles.size(); i++)
   {
      for (const Point3 &corner : triangles[i])
      {
         boxes[i].Add(corner);
      }
   }
   return boxes;
}

std::vector<Triangle> Picked(ParMesh &mesh,
                             const std::function<bool(int)> &picked)
{
   std::vector<Triangle> mine;
   for (int i = 0; i < mesh.GetNBE(); i++)
   {
      if (picked(i))
      {
         const std::vector<Triangle> face = Triangulate(mesh, i);
         mine.insert(mine.end(), face.begin(), face.end());
      }
   }
   return OnAllRanks(mine, mesh.GetComm());
}
} // namespace

std::vector<Triangle> Triangulate(ParMesh &mesh, int boundary_element)
{
   ElementTransformation &trans =
      *mesh.GetBdrElementTransformation(boundary_element);
   const Geometry::Type geometry = trans.GetGeometryType();
   const int order =
      mesh.GetNodes() ? mesh.GetNodalFESpace()->GetMaxElementOrder() : 1;
   RefinedGeometry &pieces = *GlobGeometryRefiner.Refine(geometry, order);
   DenseMatrix x;
   trans.Transform(pieces.RefPts, x);
   const auto corner = [&](int i) -> Point3 {
      return {x(0, i), x(1, i), x(2, i)};
   };
   const int corners = Geometry::NumVerts[geometry];
   std::vector<Triangle> triangles;
   for (int i = 0; i < pieces.RefGeoms.Size(); i += corners)
   {
      const int *const c = &pieces.RefGeoms[i];
      for (int k = 2; k < corners; k++)
      {
         triangles.push_back({corner(c[0]), corner(c[k - 1]), corner(c[k])});
      }
   }
   return triangles;
}

TriangulatedSurface::TriangulatedSurface(ParMesh &mesh,
                                         const std::function<bool(int)> &picked)
   : triangles(Picked(mesh, picked)), tree(BoxesOf(triangles))
{
   Box all;
   for (const Box &box : BoxesOf(triangles))
   {
      all.Add(box);
   }
   size = all.Empty() ? 0.0 : Length(Difference(all.high, all.low));
}

real_t TriangulatedSurface::Distance(const Point3 &point, real_t enough) const
{
   return tree.LeastDistance(
      point, enough,
      [&](int i) { return DistanceToTriangle(point, triangles[i]); });
}

TriangulatedSurface::Foot
TriangulatedSurface::FindFoot(const Point3 &point) const
{
   Foot foot;
   real_t least = std::numeric_limits<real_t>::infinity();
   tree.LeastDistance(
      point, 0.0,
      [&](int i)
      {
         const TriangleWeights weights = NearestWeights(point, triangles[i]);
         const real_t distance =
            Length(Difference(point, Interpolate(triangles[i], weights)));
         if (distance < least)
         {
            least = distance;
            foot = {i, weights};
         }
         return distance;
      });
   return foot;
}

real_t TriangulatedSurface::WayThrough(const Point3 &from,
                                       const Point3 &along) const
{
   real_t way = std::numeric_limits<real_t>::infinity();
   tree.VisitSegment(from, Sum(from, size, along),
                     [&](int i)
                     {
                        const Triangle &t = triangles[i];
                        const Point3 area = AreaVector(t);
                        const real_t slope = Dot(area, along);
                        if (slope < least_cosine * Length(area))
                        {
                           return;
                        }
                        const real_t s =
                           Dot(Difference(t[0], from), area) / slope;
                        if (s > starts_beyond * size && s < way &&
                            IsInside(Coordinates(Sum(from, s, along), t, area)))
                        {
                           way = s;
                        }
                     });
   return way;
}

} // namespace synovia
