#include "synovia/contact/surface_pairing.hpp"
#include "synovia/general/reduce.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace synovia
{

using namespace mfem;

namespace
{
// Faces meet where reference coordinates are this far outside of either.
constexpr real_t edge_tolerance = 1e-6;
// How far a face's continuation goes on, in reference coordinates.
constexpr real_t continuation = 0.5;

/// Distance of a point from a face it is outside of, in reference coordinates:
/// the sum of the distances beyond each edge, so that of two faces the one
/// beside the point is the nearer one, also beyond the rim.
real_t Outside(Geometry::Type geometry, const IntegrationPoint &ip)
{
   const auto beyond = [](real_t x) { return std::max<real_t>(0.0, x); };
   const real_t below = beyond(-ip.x) + beyond(-ip.y);
   return below + (geometry == Geometry::TRIANGLE
                      ? beyond(ip.x + ip.y - 1.0)
                      : beyond(ip.x - 1.0) + beyond(ip.y - 1.0));
}
} // namespace

Point3 InterpolateNormal(const std::array<Point3, 4> &vertices,
                         const Vector &shape)
{
   Point3 normal{{0.0, 0.0, 0.0}};
   for (int v = 0; v < shape.Size(); v++)
   {
      normal = Sum(normal, shape[v], vertices[v]);
   }
   return normal;
}

SurfacePairing::SurfacePairing(const ContactSurface &source_,
                               const ContactSurface &destination_,
                               const GapOptions &options_)
   : source(source_), destination(destination_), options(options_),
     normals(destination), halo(source)
{
}

SearchQuery SurfacePairing::Look(const PairedPoint &point) const
{
   Vector shape;
   destination.GetVertexShapes(point.face, point.ip, shape);
   SearchQuery query;
   query.point = destination.Faces()[point.face].Current(point.ip).position;
   query.normal = InterpolateNormal(normals.AtVertices(point.face), shape);
   const real_t length = Length(query.normal);
   for (real_t &component : query.normal)
   {
      component /= length;
   }
   return query;
}

void SurfacePairing::Segment(const FaceShares &shares_)
{
   shares = shares_;
   normals.Update();
   const auto segments = SegmentSurface(
      source, destination, options.search_radius, options.quadrature_order);
   points.clear();
   std::vector<SearchQuery> queries;
   std::vector<real_t> distances;
   for (std::size_t i = 0; i < segments.size(); i++)
   {
      const DeformedFace &face = destination.Faces()[i];
      for (const SegmentPoint &made : segments[i])
      {
         PairedPoint point;
         point.face = static_cast<int>(i);
         point.ip = made.ip;
         point.area = made.ip.weight * face.Reference(made.ip).AreaFactor();
         point.size = made.size;
         SearchQuery query = Look(point);
         query.rank = made.rank;
         query.face = made.face;
         queries.push_back(query);
         distances.push_back(made.distance);
         points.push_back(point);
      }
   }
   const SurfaceSearch search(source, options.search_radius);
   const std::vector<SearchHit> hits = search.Find(queries);
   std::size_t kept = 0;
   for (std::size_t i = 0; i < hits.size(); i++)
   {
      PairedPoint point = points[i];
      const SearchHit &hit = hits[i];
      if (hit.Found() && IsExpectedHit(hit.distance, distances[i], point.size))
      {
         point.name = {hit.rank, hit.face};
         point.hit.Set2(hit.xi, hit.eta);
         point.gap = hit.distance;
         point.first_name = point.name;
         point.first_hit = point.hit;
         points[kept++] = point;
      }
   }
   points.resize(kept);
   AskForFaces(search);
   drifted = false;
}

void SurfacePairing::AskForFaces(const SurfaceSearch &search)
{
   std::map<FaceName, int> numbers;
   for (const PairedPoint &point : points)
   {
      numbers[point.name] = 0;
      numbers[point.first_name] = 0;
   }
   names.clear();
   for (auto &[name, number] : numbers)
   {
      number = static_cast<int>(names.size());
      names.push_back(name);
   }
   for (PairedPoint &point : points)
   {
      point.source = numbers.at(point.name);
   }
   halo.Ask(search, names);
   halo.UpdateShapes();
   FindNeighbors();
   asked_since = true;
}

void SurfacePairing::FindNeighbors()
{
   std::map<HYPRE_BigInt, std::vector<int>> around;
   const int faces = static_cast<int>(names.size());
   for (int i = 0; i < faces; i++)
   {
      for (const HYPRE_BigInt vertex : halo[i].dofs.vertices)
      {
         around[vertex].push_back(i);
      }
   }
   neighbors.assign(faces, {});
   for (int i = 0; i < faces; i++)
   {
      for (const HYPRE_BigInt vertex : halo[i].dofs.vertices)
      {
         const std::vector<int> &more = around.at(vertex);
         neighbors[i].insert(neighbors[i].end(), more.begin(), more.end());
      }
      std::sort(neighbors[i].begin(), neighbors[i].end());
      neighbors[i].erase(std::unique(neighbors[i].begin(), neighbors[i].end()),
                         neighbors[i].end());
   }
}

SurfacePairing::Landing SurfacePairing::Land(const SearchQuery &query, int face,
                                             const Landing &start) const
{
   constexpr int max_iterations = 20;
   constexpr real_t small = 1e-10;
   // Beyond this many reference coordinates a face's own map says nothing.
   constexpr real_t reach_of_map = 4.0;
   const HaloFace &on = halo[face];
   Landing landing = start;
   landing.face = face;
   for (int i = 0; i < max_iterations; i++)
   {
      const SurfacePoint at = on.shape(landing.ip.x, landing.ip.y);
      const Point3 residual =
         Sum(Sum(at.position, -1.0, query.point), -landing.gap, query.normal);
      const Point3 area = at.AreaVector();
      const real_t facing = Dot(area, query.normal);
      if (!(facing < -1e-10 * Length(area)))
      {
         break;
      }
      const real_t dx =
         -Dot(Cross(at.tangents[1], query.normal), residual) / facing;
      const real_t dy =
         -Dot(Cross(query.normal, at.tangents[0]), residual) / facing;
      landing.ip.x += dx;
      landing.ip.y += dy;
      landing.gap += Dot(area, residual) / facing;
      const real_t outside = Outside(on.dofs.geometry, landing.ip);
      if (!(outside <= reach_of_map))
      {
         break;
      }
      if (std::abs(dx) + std::abs(dy) < small)
      {
         landing.outside = outside;
         return landing;
      }
   }
   return start;
}

bool SurfacePairing::Walk(PairedPoint &point) const
{
   constexpr int most_steps = 50;
   const SearchQuery query = Look(point);
   Landing best;
   best.face = point.source;
   best.ip = point.hit;
   best.gap = point.gap;
   best = Land(query, point.source, best);
   for (int step = 0; step < most_steps && best.outside > edge_tolerance;
        step++)
   {
      Landing next = best;
      for (const int neighbor : neighbors[best.face])
      {
         Landing start = best;
         start.ip = Geometries.GetCenter(halo[neighbor].dofs.geometry);
         const Landing there = Land(query, neighbor, start);
         if (there.face == neighbor && there.outside < next.outside)
         {
            next = there;
         }
      }
      if (next.face == best.face)
      {
         break;
      }
      best = next;
   }
   if (best.outside <= continuation)
   {
      point.source = best.face;
      point.name = names[best.face];
      point.hit = best.ip;
      point.gap = best.gap;
   }
   else
   {
      point.source = -1;
   }
   return best.outside <= edge_tolerance;
}

bool SurfacePairing::Follow()
{
   normals.Update();
   halo.UpdateShapes();
   std::vector<int> leaving;
   for (std::size_t i = 0; i < points.size(); i++)
   {
      const FaceName before = points[i].name;
      const bool on_face = Walk(points[i]);
      drifted = drifted || !on_face || points[i].name != before;
      if (!on_face)
      {
         leaving.push_back(static_cast<int>(i));
      }
   }
   const bool any = AnyRank(!leaving.empty(), source.Spaces().GetComm());
   if (any)
   {
      FindOtherFaces(leaving);
   }
   return any;
}

void SurfacePairing::Remember()
{
   remembered_points = points;
   remembered_drift = drifted;
   asked_since = false;
}

bool SurfacePairing::GoBack()
{
   points = remembered_points;
   drifted = remembered_drift;
   const bool others = asked_since;
   if (others)
   {
      AskForFaces(SurfaceSearch(source, options.search_radius));
      asked_since = false;
   }
   return others;
}

void SurfacePairing::FindOtherFaces(const std::vector<int> &leaving)
{
   std::vector<SearchQuery> queries;
   queries.reserve(leaving.size());
   for (const int i : leaving)
   {
      queries.push_back(Look(points[i]));
   }
   const SurfaceSearch search(source, options.search_radius);
   const std::vector<SearchHit> hits = search.Find(queries);
   for (std::size_t i = 0; i < hits.size(); i++)
   {
      PairedPoint &point = points[leaving[i]];
      const SearchHit &hit = hits[i];
      if (hit.Found() && IsExpectedHit(hit.distance, point.gap, point.size))
      {
         point.name = {hit.rank, hit.face};
         point.hit.Set2(hit.xi, hit.eta);
         point.gap = hit.distance;
         point.source = 0;
      }
   }
   points.erase(std::remove_if(points.begin(), points.end(),
                               [](const PairedPoint &point)
                               { return !point.Counts(); }),
                points.end());
   AskForFaces(search);
}

bool SurfacePairing::HasDrifted() const
{
   return AnyRank(drifted, source.Spaces().GetComm());
}

real_t SurfacePairing::Slid() const
{
   // Of the size of a face: round surfaces that touch at a point.
   constexpr real_t nearly = 0.05;
   real_t farthest = -1.0;
   for (const PairedPoint &point : points)
   {
      if (point.gap > nearly * point.size)
      {
         continue;
      }
      const auto first =
         std::lower_bound(names.begin(), names.end(), point.first_name);
      const Point3 from = halo[static_cast<int>(first - names.begin())]
                             .shape(point.first_hit.x, point.first_hit.y)
                             .position;
      const Point3 to =
         halo[point.source].shape(point.hit.x, point.hit.y).position;
      farthest = std::max(farthest, Length(Sum(to, -1.0, from)) / point.size);
   }
   farthest = MaxOverRanks(farthest, source.Spaces().GetComm());
   return farthest < 0.0 ? infinity() : farthest;
}

} // namespace synovia
