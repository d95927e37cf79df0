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
   return std::acos(std::clamp<real_t>(-Dot(own, other), -1.0, 1.0));
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

std::vector<VertexShares> BearingShares(const SurfacePairing &pairing,
                                        const RimVertices &rim,
                                        real_t bearing_angle)
{
   // The narrower the fall, the more a search undoes of what led to it.
   constexpr real_t none = 4.0;
   std::vector<real_t> angles;
   angles.reserve(pairing.Points().size());
   for (const PairedPoint &point : pairing.Points())
   {
      angles.push_back(FacingAngle(pairing, point));
   }
   Vector least = LeastAngles(pairing, angles, bearing_angle);
   rim.Spread(least);
   least = pairing.Destination().Vertices().Share(least);
   std::vector<VertexShares> shares(angles.size());
   for (std::size_t i = 0; i < angles.size(); i++)
   {
      const int face = pairing.Points()[i].face;
      const Array<int> &vertices =
         pairing.Destination().Faces()[face].Vertices();
      for (int j = 0; j < vertices.Size(); j++)
      {
         const real_t beyond = (angles[i] - least[vertices[j]]) / bearing_angle;
         shares[i][j] =
            std::clamp<real_t>((none - beyond) / (none - 1.0), 0.0, 1.0);
      }
   }
   return shares;
}

} // namespace synovia
