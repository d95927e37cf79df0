#include "synovia/contact/bearing_shares.hpp"
#include "synovia/contact/vertex_blocks.hpp"

#include <algorithm>
#include <cmath>

namespace synovia
{

using namespace mfem;

Vector LeastAngles(const SurfacePairing &pairing, real_t bearing_angle)
{
   // Weights stay above zero, so that a narrow angle leaves no vertex without.
   constexpr real_t most = 100.0;
   const ContactSurface &destination = pairing.Destination();
   VertexSums weights(destination.Vertices());
   VertexSums angles(destination.Vertices());
   Vector weight;
   for (const PairedPoint &point : pairing.Points())
   {
      const Array<int> &vertices = destination.Faces()[point.face].Vertices();
      destination.GetVertexShapes(point.face, point.ip, weight);
      weight *= point.area *
                std::exp(-std::min(most, 2.0 * point.angle / bearing_angle));
      weights.Add(vertices, 1.0, weight);
      angles.Add(vertices, point.angle, weight);
   }
   Vector least = angles.OverRanks();
   const Vector total = weights.OverRanks();
   for (int j = 0; j < least.Size(); j++)
   {
      least[j] = total[j] > 0.0 ? least[j] / total[j] : 0.0;
   }
   return least;
}

void SetBearingShares(const ContactSurface &destination, const Vector &least,
                      real_t bearing_angle, std::vector<PairedPoint> &points)
{
   // The narrower the fall, the more a search undoes of what led to it.
   constexpr real_t none = 4.0;
   const Vector local_least = destination.Vertices().Share(least);
   for (PairedPoint &point : points)
   {
      const Array<int> &vertices = destination.Faces()[point.face].Vertices();
      for (int j = 0; j < vertices.Size(); j++)
      {
         const real_t beyond =
            (point.angle - local_least[vertices[j]]) / bearing_angle;
         point.share[j] =
            std::clamp<real_t>((none - beyond) / (none - 1.0), 0.0, 1.0);
      }
   }
}

} // namespace synovia
