#include "synovia/contact/bearing_shares.hpp"
#include "synovia/contact/vertex_blocks.hpp"

#include <algorithm>
#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
real_t FacingAngle(const SurfacePairing &pairing, const PairedPoint &point)
{
   const Point3 own =
      pairing.Destination().Faces()[point.face].Current(point.ip).UnitNormal();
   const Point3 other = pairing.SourceFaces()[point.source]
                           .shape(point.hit.x, point.hit.y)
                           .UnitNormal();
   return std::atan2(Length(Cross(own, other)), -Dot(own, other));
}

/// The angle around each of this rank's vertices where it is least; zero where
/// there are no points. @a angles: of the points.
Vector LeastAngles(const SurfacePairing &pairing,
                   const std::vector<real_t> &angles, real_t bearing_angle)
{
   // Weights stay above zero, so that a narrow angle leaves no vertex without.
   constexpr real_t most = 100.0;
   const ContactSurface &destination = pairing.Destination();
   VertexSums weights(destination.Vertices());
   VertexSums sums(destination.Vertices());
   Vector weight;
   for (std::size_t i = 0; i < angles.size(); i++)
   {
      const PairedPoint &point = pairing.Points()[i];
      const Array<int> &vertices = destination.Faces()[point.face].Vertices();
      destination.GetVertexShapes(point.face, point.ip, weight);
      weight *= point.area *
                std::exp(-std::min(most, 2.0 * angles[i] / bearing_angle));
      weights.Add(vertices, 1.0, weight);
      sums.Add(vertices, angles[i], weight);
   }
   Vector least = sums.OverRanks();
   const Vector total = weights.OverRanks();
   for (int j = 0; j < least.Size(); j++)
   {
      least[j] = total[j] > 0.0 ? least[j] / total[j] : 0.0;
   }
   return least;
}
} // namespace

FaceShares BearingShares(const SurfacePairing &pairing, const RimVertices &rim,
                         real_t bearing_angle)
{
   // The narrower the fall, the more shares differ between steps.
   constexpr real_t none = 2.0;
   const ContactSurface &destination = pairing.Destination();
   const std::vector<PairedPoint> &points = pairing.Points();
   std::vector<real_t> angles;
   angles.reserve(points.size());
   for (const PairedPoint &point : points)
   {
      angles.push_back(FacingAngle(pairing, point));
   }
   Vector least = LeastAngles(pairing, angles, bearing_angle);
   rim.Spread(least);
   least = destination.Vertices().Share(least);
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
            const real_t beyond =
               (angles[end] - least[vertices[j]]) / bearing_angle;
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
