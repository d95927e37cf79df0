#include "synovia/contact/contact_area.hpp"
#include "synovia/general/reduce.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
using Triple = std::array<real_t, 3>;

/// Means over a triangle of its linear shape functions, cut off where the
/// function with these values at the corners is not negative.
Triple NegativeMeans(const Triple &values)
{
   constexpr real_t third = 1.0 / 3.0;
   const auto negative = [&](int i) { return values[i] < 0.0; };
   const int count = negative(0) + negative(1) + negative(2);
   if (count == 0 || count == 3)
   {
      const real_t mean = count == 0 ? 0.0 : third;
      return {mean, mean, mean};
   }
   // The zero line cuts off one corner.
   const bool tip_is_negative = count == 1;
   int tip = 0;
   while (negative(tip) != tip_is_negative)
   {
      tip++;
   }
   const int next = (tip + 1) % 3;
   const int last = (tip + 2) % 3;
   const real_t to_next = values[tip] / (values[tip] - values[next]);
   const real_t to_last = values[tip] / (values[tip] - values[last]);
   const real_t size = to_next * to_last;
   Triple means;
   means[next] = third * size * to_next;
   means[last] = third * size * to_last;
   means[tip] = size - means[next] - means[last];
   if (!tip_is_negative)
   {
      for (real_t &mean : means)
      {
         mean = third - mean;
      }
   }
   return means;
}

/// How much of int phi_j remains over the negative part of a face.
using Shares = std::array<real_t, 4>;

Shares TriangleShares(const Array<int> &vertices, const Vector &values)
{
   const Triple means = NegativeMeans(
      {values[vertices[0]], values[vertices[1]], values[vertices[2]]});
   return {3.0 * means[0], 3.0 * means[1], 3.0 * means[2], 0.0};
}

Shares SquareShares(const Array<int> &vertices, const Vector &values)
{
   Shares shares{{0.0, 0.0, 0.0, 0.0}};
   real_t center = 0.0;
   for (const int vertex : vertices)
   {
      center += 0.25 * values[vertex];
   }
   for (int i = 0; i < 4; i++)
   {
      const int next = (i + 1) % 4;
      const Triple means =
         NegativeMeans({values[vertices[i]], values[vertices[next]], center});
      shares[i] += means[0];
      shares[next] += means[1];
      for (real_t &share : shares)
      {
         share += 0.25 * means[2];
      }
   }
   return shares;
}

Shares NegativeShares(const Array<int> &vertices, const Vector &values)
{
   return vertices.Size() == 3 ? TriangleShares(vertices, values)
                               : SquareShares(vertices, values);
}

/// Mean of a linear or bilinear function over a face, weighted by the shape
/// function of its vertex number @a j.
real_t MeanAround(int j, const Array<int> &vertices, const Vector &values)
{
   const int count = vertices.Size();
   const auto value = [&](int i) { return values[vertices[(j + i) % count]]; };
   return count == 3
             ? (2.0 * value(0) + value(1) + value(2)) / 4.0
             : (4.0 * value(0) + 2.0 * value(1) + value(2) + 2.0 * value(3)) /
                  9.0;
}
} // namespace

Vector VertexMeans(const ContactSurface &destination,
                   const std::vector<FaceCoverage> &coverage,
                   const Vector &values)
{
   const SurfaceVertices &surface = destination.Vertices();
   const Vector local = surface.Share(values);
   Vector integrals(local.Size());
   Vector areas(local.Size());
   integrals = 0.0;
   areas = 0.0;
   for (const FaceCoverage &covered : coverage)
   {
      const Array<int> &vertices = destination.Faces()[covered.face].Vertices();
      for (int j = 0; j < vertices.Size(); j++)
      {
         integrals[vertices[j]] +=
            covered.area[j] * MeanAround(j, vertices, local);
         areas[vertices[j]] += covered.area[j];
      }
   }
   Vector means = surface.SumShared(integrals);
   areas = surface.SumShared(areas);
   for (int j = 0; j < means.Size(); j++)
   {
      means[j] = areas[j] > 0.0 ? means[j] / areas[j] : 0.0;
   }
   return means;
}

real_t NegativeArea(const ContactSurface &destination,
                    const std::vector<FaceCoverage> &coverage,
                    const Vector &values)
{
   const Vector local = destination.Vertices().Share(values);
   real_t area = 0.0;
   for (const FaceCoverage &covered : coverage)
   {
      const Array<int> &vertices = destination.Faces()[covered.face].Vertices();
      const Shares shares = NegativeShares(vertices, local);
      for (int j = 0; j < vertices.Size(); j++)
      {
         area += shares[j] * covered.area[j];
      }
   }
   return SumOverRanks(area, destination.Spaces().GetComm());
}

} // namespace synovia
