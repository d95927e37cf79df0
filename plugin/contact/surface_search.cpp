#include "synovia/contact/surface_search.hpp"
#include "synovia/general/exchange.hpp"

#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
// How far outside a face, in its reference coordinates, still counts as on it,
// so that no ray slips through between two faces.
constexpr real_t on_face_tolerance = 1e-6;

// A face turned sideways or away is not a partner: its normal must be against
// the query's by at least this cosine.
constexpr real_t opposing_cosine = -0.2;

std::vector<Box> FaceBoxes(const ContactSurface &surface)
{
   std::vector<Box> boxes;
   boxes.reserve(surface.Faces().size());
   for (const DeformedFace &face : surface.Faces())
   {
      boxes.push_back(face.CurrentBox());
   }
   return boxes;
}

std::vector<Box> RankBoxes(const ContactSurface &surface)
{
   Box mine;
   for (const Box &box : FaceBoxes(surface))
   {
      mine.Add(box);
   }
   MPI_Comm comm = surface.Spaces().GetComm();
   int size;
   MPI_Comm_size(comm, &size);
   std::vector<Box> boxes(size);
   MPI_Allgather(&mine, sizeof(Box), MPI_BYTE, boxes.data(), sizeof(Box),
                 MPI_BYTE, comm);
   return boxes;
}

bool Inside(Geometry::Type geometry, const IntegrationPoint &ip)
{
   if (ip.x < -on_face_tolerance || ip.y < -on_face_tolerance)
   {
      return false;
   }
   return geometry == Geometry::TRIANGLE
             ? ip.x + ip.y <= 1.0 + on_face_tolerance
             : ip.x <= 1.0 + on_face_tolerance &&
                  ip.y <= 1.0 + on_face_tolerance;
}

// Solves x(xi, eta) = point + s normal by Newton's method from the center; says
// how the face's normal there lies to the query's.
bool IntersectFace(const DeformedFace &face, const SearchQuery &query,
                   IntegrationPoint &ip, real_t &distance, real_t &cosine)
{
   constexpr int max_iterations = 20;
   ip = Geometries.GetCenter(face.GetGeometry());
   distance = 0.0;
   for (int i = 0; i < max_iterations; i++)
   {
      const SurfacePoint at = face.Current(ip);
      const std::array<Point3, 2> &t = at.tangents;
      const Point3 residual =
         Sum(Sum(at.position, -1.0, query.point), -distance, query.normal);
      // Cramer's rule for [t0 t1 -n] (dxi, deta, ds) = -residual.
      const Point3 area = at.AreaVector();
      const real_t det = -Dot(area, query.normal);
      const real_t scale = Length(area);
      if (std::abs(det) < 1e-10 * scale)
      {
         return false;
      }
      const real_t dxi = Dot(Cross(residual, t[1]), query.normal) / det;
      const real_t deta = Dot(Cross(t[0], residual), query.normal) / det;
      const real_t ds = -Dot(area, residual) / det;
      ip.x += dxi;
      ip.y += deta;
      distance += ds;
      // The next step would be as small as the square of this one.
      if (std::abs(dxi) + std::abs(deta) < 1e-8)
      {
         cosine = -det / scale;
         return true;
      }
      if (std::abs(ip.x) > 4.0 || std::abs(ip.y) > 4.0)
      {
         return false;
      }
   }
   return false;
}
} // namespace

SurfaceSearch::SurfaceSearch(const ContactSurface &surface_, real_t radius_)
   : surface(surface_), radius(radius_), comm(surface.Spaces().GetComm()),
     faces(FaceBoxes(surface)), ranks(RankBoxes(surface))
{
   MPI_Comm_size(comm, &size);
   MPI_Comm_rank(comm, &rank);
}

SearchHit SurfaceSearch::HitFace(const SearchQuery &query, int index) const
{
   SearchHit hit;
   const DeformedFace &face = surface.Faces()[index];
   IntegrationPoint ip;
   real_t distance;
   real_t cosine;
   if (IntersectFace(face, query, ip, distance, cosine) &&
       Inside(face.GetGeometry(), ip) && std::abs(distance) <= radius &&
       cosine <= opposing_cosine)
   {
      hit.rank = rank;
      hit.face = index;
      hit.xi = ip.x;
      hit.eta = ip.y;
      hit.distance = distance;
   }
   return hit;
}

SearchHit SurfaceSearch::FindLocal(const SearchQuery &query) const
{
   SearchHit best;
   if (query.rank == rank && query.face >= 0)
   {
      best = HitFace(query, query.face);
   }
   if (!best.Found())
   {
      faces.VisitSegment(Sum(query.point, -radius, query.normal),
                         Sum(query.point, radius, query.normal),
                         [&](int i) { best.TakeNearer(HitFace(query, i)); });
   }
   if (best.Found())
   {
      const DeformedFace &face = surface.Faces()[best.face];
      IntegrationPoint ip;
      ip.Set2(best.xi, best.eta);
      const SurfacePoint at = face.Reference(ip);
      best.reference = at.position;
      best.normal = at.UnitNormal();
   }
   return best;
}

std::vector<SearchHit>
SurfaceSearch::AskRanks(const std::vector<SearchQuery> &queries,
                        const std::vector<std::vector<int>> &asked) const
{
   std::vector<std::vector<SearchQuery>> outgoing(size);
   for (int r = 0; r < size; r++)
   {
      outgoing[r].reserve(asked[r].size());
      for (const int q : asked[r])
      {
         outgoing[r].push_back(queries[q]);
      }
   }
   const auto incoming = Exchange(std::move(outgoing), comm);
   std::vector<std::vector<SearchHit>> answers(size);
   for (int r = 0; r < size; r++)
   {
      answers[r].reserve(incoming[r].size());
      for (const SearchQuery &query : incoming[r])
      {
         answers[r].push_back(FindLocal(query));
      }
   }
   const auto returned = Exchange(std::move(answers), comm);
   std::vector<SearchHit> hits(queries.size());
   for (int r = 0; r < size; r++)
   {
      for (size_t i = 0; i < returned[r].size(); i++)
      {
         hits[asked[r][i]].TakeNearer(returned[r][i]);
      }
   }
   return hits;
}

std::vector<SearchHit>
SurfaceSearch::Find(const std::vector<SearchQuery> &queries) const
{
   std::vector<std::vector<int>> named(size);
   for (size_t q = 0; q < queries.size(); q++)
   {
      if (queries[q].face >= 0)
      {
         named[queries[q].rank].push_back(static_cast<int>(q));
      }
   }
   std::vector<SearchHit> hits = AskRanks(queries, named);
   std::vector<size_t> missed;
   std::vector<SearchQuery> again;
   std::vector<std::vector<int>> others(size);
   for (size_t q = 0; q < queries.size(); q++)
   {
      if (hits[q].Found())
      {
         continue;
      }
      const int tried = queries[q].face >= 0 ? queries[q].rank : -1;
      ranks.VisitSegment(Sum(queries[q].point, -radius, queries[q].normal),
                         Sum(queries[q].point, radius, queries[q].normal),
                         [&](int r)
                         {
                            if (r != tried)
                            {
                               others[r].push_back(
                                  static_cast<int>(again.size()));
                            }
                         });
      missed.push_back(q);
      again.push_back(queries[q]);
   }
   const std::vector<SearchHit> found = AskRanks(again, others);
   for (size_t i = 0; i < missed.size(); i++)
   {
      hits[missed[i]].TakeNearer(found[i]);
   }
   return hits;
}

FaceDofs GetFaceDofs(const ContactSurface &surface, int index)
{
   const DeformedFace &face = surface.Faces()[index];
   const auto globals = [](const Array<int> &dofs, const auto &global)
   {
      std::vector<HYPRE_BigInt> result;
      result.reserve(dofs.Size());
      for (const int dof : dofs)
      {
         result.push_back(global(dof));
      }
      return result;
   };
   BiphasicSpaces &spaces = surface.Spaces();
   return {face.GetGeometry(),
           globals(face.DisplacementDofs(), [&](int dof)
                   { return spaces.Displacement().GetGlobalTDofNumber(dof); }),
           globals(face.PressureDofs(), [&](int dof)
                   { return spaces.Pressure().GetGlobalTDofNumber(dof); }),
           globals(face.Vertices(), [&](int vertex)
                   { return surface.Vertices().Global(vertex); })};
}

std::vector<FaceDofs>
SurfaceSearch::GetFaceDofs(const std::vector<std::pair<int, int>> &faces) const
{
   std::vector<std::vector<int>> requests(size);
   for (const auto &[owner, face] : faces)
   {
      requests[owner].push_back(face);
   }
   const auto asked = Exchange(std::move(requests), comm);
   std::vector<std::vector<HYPRE_BigInt>> replies(size);
   for (int r = 0; r < size; r++)
   {
      for (const int face : asked[r])
      {
         const FaceDofs dofs = synovia::GetFaceDofs(surface, face);
         std::vector<HYPRE_BigInt> &reply = replies[r];
         reply.push_back(dofs.geometry);
         for (const auto *list :
              {&dofs.displacement, &dofs.pressure, &dofs.vertices})
         {
            reply.push_back(static_cast<HYPRE_BigInt>(list->size()));
            reply.insert(reply.end(), list->begin(), list->end());
         }
      }
   }
   const auto received = Exchange(std::move(replies), comm);
   std::vector<size_t> position(size, 0);
   std::vector<FaceDofs> result;
   result.reserve(faces.size());
   for (const auto &[owner, face] : faces)
   {
      const std::vector<HYPRE_BigInt> &data = received[owner];
      size_t &at = position[owner];
      FaceDofs dofs;
      dofs.geometry = static_cast<Geometry::Type>(data[at++]);
      for (auto *list : {&dofs.displacement, &dofs.pressure, &dofs.vertices})
      {
         const size_t count = data[at++];
         list->assign(data.begin() + at, data.begin() + at + count);
         at += count;
      }
      result.push_back(std::move(dofs));
   }
   return result;
}

} // namespace synovia
