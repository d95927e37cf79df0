#include "synovia/contact/segmentation.hpp"
#include "synovia/contact/polygon_clip.hpp"
#include "synovia/general/exchange.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace synovia
{

using namespace mfem;

namespace
{
// An edge whose middle is farther than this part of its length from the line
// between its ends is taken for bent.
constexpr real_t straight = 1e-3;
// Beyond this many reference coordinates from a face's center, its own map says
// nothing about where a point lies; the tangent plane at the center does.
constexpr real_t reach_of_map = 4.0;

/// The global numbers of the two vertices that a corner lies between, the
/// smaller one first; of a vertex, its own twice.
using CornerName = std::array<HYPRE_BigInt, 2>;

/// Outline of a source face.
struct Facet
{
   static constexpr int most_corners = 8;
   int corners = 0;
   std::array<Point3, most_corners> points;
   std::array<CornerName, most_corners> names;
   real_t size = 0.0;
   int rank = -1;
   int face = -1;

   Box GetBox() const
   {
      Box box;
      for (int i = 0; i < corners; i++)
      {
         box.Add(points[i]);
      }
      // The face itself bulges out of the polygon.
      box.Inflate(0.1 * box.LongestEdge());
      return box;
   }
};

Facet Outline(const DeformedFace &face, const SurfaceVertices &surface)
{
   const IntegrationRule &ends = *Geometries.GetVertices(face.GetGeometry());
   const int edges = ends.GetNPoints();
   const Array<int> &vertices = face.Vertices();
   Facet facet;
   const auto add = [&](const Point3 &point, HYPRE_BigInt i, HYPRE_BigInt j)
   {
      facet.points[facet.corners] = point;
      facet.names[facet.corners] = {std::min(i, j), std::max(i, j)};
      facet.corners++;
   };
   for (int i = 0; i < edges; i++)
   {
      const int next = (i + 1) % edges;
      const IntegrationPoint &from = ends.IntPoint(i);
      const IntegrationPoint &to = ends.IntPoint(next);
      const Point3 a = face.Current(from).position;
      const Point3 b = face.Current(to).position;
      IntegrationPoint middle;
      middle.Set2(0.5 * (from.x + to.x), 0.5 * (from.y + to.y));
      const Point3 m = face.Current(middle).position;
      const real_t length = Length(Sum(b, -1.0, a));
      const Point3 bend = Sum(Sum(m, -0.5, a), -0.5, b);
      facet.size = std::max(facet.size, length);
      const HYPRE_BigInt first = surface.Global(vertices[i]);
      add(a, first, first);
      if (Length(bend) > straight * length)
      {
         add(m, first, surface.Global(vertices[next]));
      }
   }
   return facet;
}

/// A box around what is within @a radius of a face along its normals.
Box Swept(const DeformedFace &face, real_t radius)
{
   Box box;
   const IntegrationRule &vertices =
      *Geometries.GetVertices(face.GetGeometry());
   for (int i = 0; i < vertices.GetNPoints(); i++)
   {
      const IntegrationPoint &ip = vertices.IntPoint(i);
      const SurfacePoint at = face.Current(ip);
      const Point3 normal = at.UnitNormal();
      box.Add(Sum(at.position, radius, normal));
      box.Add(Sum(at.position, -radius, normal));
   }
   box.Add(face.CurrentBox());
   return box;
}

Box Swept(const ContactSurface &surface, real_t radius)
{
   Box box;
   for (const DeformedFace &face : surface.Faces())
   {
      box.Add(Swept(face, radius));
   }
   return box;
}

/// Forgets which faces the points belong to if there are more of them than the
/// face has room for.
void ForgetIfOverlapping(Geometry::Type geometry,
                         std::vector<SegmentPoint> &points)
{
   constexpr real_t round_off = 1e-6;
   real_t covered = 0.0;
   for (const SegmentPoint &point : points)
   {
      covered += point.ip.weight;
   }
   if (covered > (1.0 + round_off) * Geometry::Volume[geometry])
   {
      for (SegmentPoint &point : points)
      {
         point.rank = -1;
         point.face = -1;
      }
   }
}

/// The source faces that come near this rank's part of the destination.
std::vector<Facet> FacetsNearby(const ContactSurface &source,
                                const ContactSurface &destination,
                                real_t radius)
{
   MPI_Comm comm = source.Spaces().GetComm();
   int ranks = 1;
   int rank = 0;
   MPI_Comm_size(comm, &ranks);
   MPI_Comm_rank(comm, &rank);
   const Box mine = Swept(destination, radius);
   std::vector<Box> boxes(ranks);
   MPI_Allgather(&mine, sizeof(Box), MPI_BYTE, boxes.data(), sizeof(Box),
                 MPI_BYTE, comm);
   const BoundingVolumeTree tree(boxes);
   std::vector<std::vector<Facet>> outgoing(ranks);
   for (std::size_t i = 0; i < source.Faces().size(); i++)
   {
      Facet facet = Outline(source.Faces()[i], source.Vertices());
      facet.rank = rank;
      facet.face = static_cast<int>(i);
      tree.VisitBox(facet.GetBox(),
                    [&](int r) { outgoing[r].push_back(facet); });
   }
   std::vector<Facet> facets;
   for (const std::vector<Facet> &part : Exchange(std::move(outgoing), comm))
   {
      facets.insert(facets.end(), part.begin(), part.end());
   }
   return facets;
}

/// Where a destination face's normal goes through a point.
struct Image
{
   /// Reference coordinates.
   Point2 xi{{0.0, 0.0}};
   real_t distance = 0.0;
};

/// Where the normals of a face go through the corners of source faces.
class Projection
{
public:
   explicit Projection(const DeformedFace &face_)
      : face(face_), center(Geometries.GetCenter(face.GetGeometry())),
        middle(face.CurrentBent(center))
   {
   }

   /// One corner has one image, whichever source face it belongs to, so that
   /// the images of neighbors neither overlap nor leave a gap.
   const Image &Project(const CornerName &name, const Point3 &point)
   {
      const auto [position, added] = images.try_emplace(name);
      Image &image = position->second;
      if (added && !ProjectOnFace(point, image))
      {
         const SurfacePoint &at = middle.point;
         const Point3 d = Sum(point, -1.0, at.position);
         const Point2 step = Solve(Metric(at), d, at.tangents);
         image.xi = {center.x + step[0], center.y + step[1]};
         image.distance = Dot(d, at.UnitNormal());
      }
      return image;
   }

private:
   /// Of a symmetric matrix, by xi twice, by both, by eta twice.
   using Symmetric2 = std::array<real_t, 3>;

   static Symmetric2 Metric(const SurfacePoint &at)
   {
      const std::array<Point3, 2> &t = at.tangents;
      return {Dot(t[0], t[0]), Dot(t[0], t[1]), Dot(t[1], t[1])};
   }

   static real_t Determinant(const Symmetric2 &m)
   {
      return m[0] * m[2] - m[1] * m[1];
   }

   /// Half the second derivatives of the squared distance as the face's
   /// curvature makes them, or, where they may not be positive, the metric. How
   /// the reference coordinates bend in the face has no say: it makes minima
   /// where none is on the face.
   static Symmetric2 Hessian(const BentSurfacePoint &at, const Point3 &d)
   {
      constexpr real_t positive = 0.2;
      const Symmetric2 metric = Metric(at.point);
      const Point3 normal = at.point.UnitNormal();
      const real_t distance = Dot(d, normal);
      Symmetric2 hessian;
      for (int i = 0; i < 3; i++)
      {
         hessian[i] = metric[i] - distance * Dot(normal, at.second[i]);
      }
      const bool usable = hessian[0] > positive * metric[0] &&
                          Determinant(hessian) > positive * Determinant(metric);
      return usable ? hessian : metric;
   }

   static Point2 Solve(const Symmetric2 &m, const Point3 &d,
                       const std::array<Point3, 2> &t)
   {
      const real_t a = Dot(d, t[0]);
      const real_t b = Dot(d, t[1]);
      const real_t det = Determinant(m);
      return {(m[2] * a - m[1] * b) / det, (m[0] * b - m[1] * a) / det};
   }

   bool ProjectOnFace(const Point3 &point, Image &image) const
   {
      constexpr int max_iterations = 30;
      // Little more than round-off makes where faces are small.
      constexpr real_t small = 1e-12;
      IntegrationPoint ip = center;
      BentSurfacePoint at = middle;
      for (int i = 0; i < max_iterations; i++)
      {
         const Point3 d = Sum(point, -1.0, at.point.position);
         const Point2 step = Solve(Hessian(at, d), d, at.point.tangents);
         ip.x += step[0];
         ip.y += step[1];
         if (std::abs(ip.x - center.x) > reach_of_map ||
             std::abs(ip.y - center.y) > reach_of_map)
         {
            return false;
         }
         if (std::abs(step[0]) + std::abs(step[1]) < small)
         {
            image.xi = {ip.x, ip.y};
            image.distance = Dot(d, at.point.UnitNormal());
            return true;
         }
         at = face.CurrentBent(ip);
      }
      return false;
   }

   const DeformedFace &face;
   const IntegrationPoint center;
   const BentSurfacePoint middle;
   std::map<CornerName, Image> images;
};

/// The distances at the corners of a polygon as a linear function: the plane
/// whose normal is the polygon's area vector (Newell), through the mean of the
/// corners. No three corners would do, as one in the middle of an edge is next
/// to collinear with its ends.
class DistancePlane
{
public:
   DistancePlane(const Polygon &corners, const std::vector<real_t> &distances)
   {
      const size_t n = corners.size();
      Point3 area{{0.0, 0.0, 0.0}};
      for (size_t i = 0; i < n; i++)
      {
         const Point3 at = Corner(corners, distances, i);
         const Point3 next = Corner(corners, distances, (i + 1) % n);
         area = Sum(area, 1.0, Cross(at, next));
         mean = Sum(mean, 1.0 / static_cast<real_t>(n), at);
      }
      if (area[2] != 0.0)
      {
         slope = {-area[0] / area[2], -area[1] / area[2]};
      }
   }
   real_t operator()(const IntegrationPoint &ip) const
   {
      return mean[2] + slope[0] * (ip.x - mean[0]) +
             slope[1] * (ip.y - mean[1]);
   }

private:
   static Point3 Corner(const Polygon &corners,
                        const std::vector<real_t> &distances, size_t i)
   {
      return {corners[i][0], corners[i][1], distances[i]};
   }

   Point3 mean{{0.0, 0.0, 0.0}};
   Point2 slope{{0.0, 0.0}};
};

void AppendSegment(const DeformedFace &face, Projection &projection,
                   const Facet &facet, int order,
                   std::vector<SegmentPoint> &points)
{
   Polygon image(facet.corners);
   std::vector<real_t> distances(facet.corners);
   for (int i = 0; i < facet.corners; i++)
   {
      const Image &at = projection.Project(facet.names[i], facet.points[i]);
      image[i] = at.xi;
      distances[i] = at.distance;
   }
   // Faces towards the destination have the opposite orientation.
   if (SignedArea(image) >= 0.0)
   {
      return;
   }
   std::reverse(image.begin(), image.end());
   std::reverse(distances.begin(), distances.end());
   const Polygon segment = ClipToReference(image, face.GetGeometry());
   std::vector<IntegrationPoint> rule;
   AppendRule(segment, order, rule);
   const DistancePlane plane(image, distances);
   for (const IntegrationPoint &ip : rule)
   {
      points.push_back({ip, plane(ip), facet.size, facet.rank, facet.face});
   }
}
} // namespace

std::vector<std::vector<SegmentPoint>>
SegmentSurface(const ContactSurface &source, const ContactSurface &destination,
               real_t radius, int order)
{
   const std::vector<Facet> facets = FacetsNearby(source, destination, radius);
   std::vector<Box> boxes;
   boxes.reserve(facets.size());
   for (const Facet &facet : facets)
   {
      boxes.push_back(facet.GetBox());
   }
   const BoundingVolumeTree tree(boxes);
   std::vector<std::vector<SegmentPoint>> segments;
   segments.reserve(destination.Faces().size());
   for (const DeformedFace &face : destination.Faces())
   {
      segments.emplace_back();
      Projection projection(face);
      tree.VisitBox(Swept(face, radius),
                    [&](int i) {
                       AppendSegment(face, projection, facets[i], order,
                                     segments.back());
                    });
      ForgetIfOverlapping(face.GetGeometry(), segments.back());
   }
   return segments;
}

} // namespace synovia
