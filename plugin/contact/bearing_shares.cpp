#include "synovia/contact/bearing_shares.hpp"
#include "synovia/contact/vertex_blocks.hpp"
#include "synovia/general/angle_between.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
/// Where one of the destination's points faces the source.
struct Facing
{
   Point3 normal;
   /// Between the normal and the opposite of the source's.
   real_t angle;
};

Facing FacingAt(const SurfacePairing &pairing, const PairedPoint &point)
{
   const Point3 own =
      pairing.Destination().Faces()[point.face].Current(point.ip).UnitNormal();
   const Point3 other = pairing.SourceFaces()[point.source]
                           .shape(point.hit.x, point.hit.y)
                           .UnitNormal();
   return {own, M_PI - AngleBetween(own, other)};
}

/// Means around vertices of the destination, which points count for the more
/// the better they face the source; zero where there are no points.
struct BestFacing
{
   Vector angles;
   /// Their directions, by component.
   std::array<Vector, 3> normals;

   Point3 Normal(int vertex) const
   {
      return {normals[0][vertex], normals[1][vertex], normals[2][vertex]};
   }
};

/// Of this rank's vertices, and at those of the @a rim what they take from
/// others.
BestFacing FindBest(const SurfacePairing &pairing, const RimVertices &rim,
                    const std::vector<Facing> &facing, real_t bearing_angle)
{
   // Weights stay above zero, so that a narrow angle leaves no vertex without.
   constexpr real_t most = 100.0;
   const ContactSurface &destination = pairing.Destination();
   const SurfaceVertices &surface = destination.Vertices();
   VertexSums weights(surface);
   VertexSums angles(surface);
   std::array<VertexSums, 3> normals{
      {VertexSums(surface), VertexSums(surface), VertexSums(surface)}};
   Vector weight;
   for (std::size_t i = 0; i < facing.size(); i++)
   {
      const PairedPoint &point = pairing.Points()[i];
      const Array<int> &vertices = destination.Faces()[point.face].Vertices();
      destination.GetVertexShapes(point.face, point.ip, weight);
      weight *=
         point.area *
         std::exp(-std::min(most, 2.0 * facing[i].angle / bearing_angle));
      weights.Add(vertices, 1.0, weight);
      angles.Add(vertices, facing[i].angle, weight);
      for (int d = 0; d < 3; d++)
      {
         normals[d].Add(vertices, facing[i].normal[d], weight);
      }
   }
   const Vector total = weights.OverRanks();
   const auto mean = [&](const VertexSums &sums)
   {
      Vector means = sums.OverRanks();
      for (int j = 0; j < means.Size(); j++)
      {
         means[j] = total[j] > 0.0 ? means[j] / total[j] : 0.0;
      }
      rim.Spread(means);
      return surface.Share(means);
   };
   return {mean(angles),
           {{mean(normals[0]), mean(normals[1]), mean(normals[2])}}};
}
} // namespace

FaceShares BearingShares(const SurfacePairing &pairing, const RimVertices &rim,
                         real_t bearing_angle)
{
   // The narrower the fall, the more shares differ between steps.
   constexpr real_t none = 2.0;
   const ContactSurface &destination = pairing.Destination();
   const std::vector<PairedPoint> &points = pairing.Points();
   std::vector<Facing> facing;
   facing.reserve(points.size());
   for (const PairedPoint &point : points)
   {
      facing.push_back(FacingAt(pairing, point));
   }
   const BestFacing best = FindBest(pairing, rim, facing, bearing_angle);
   FaceShares shares(destination.Faces().size(), {{1.0, 1.0, 1.0, 1.0}});
   for (std::size_t begin = 0, end = 0; begin < points.size(); begin = end)
   {
      const int face = points[begin].face;
      const Array<int> &vertices = destination.Faces()[face].Vertices();
      std::array<real_t, 4> borne{{0.0, 0.0, 0.0, 0.0}};
      real_t area = 0.0;
      for (; end < points.size() && points[end].face == face; end++)
      {
         area += points[end].area;
         for (int j = 0; j < vertices.Size(); j++)
         {
            const real_t away = facing[end].angle - best.angles[vertices[j]];
            const real_t turn =
               AngleBetween(facing[end].normal, best.Normal(vertices[j]));
            const real_t beyond = std::min(away, turn) / bearing_angle;
            borne[j] +=
               points[end].area *
               std::clamp<real_t>((none - beyond) / (none - 1.0), 0.0, 1.0);
         }
      }
      for (int j = 0; j < vertices.Size(); j++)
      {
         shares[face][j] = borne[j] / area;
      }
   }
   return shares;
}

} // namespace synovia
