#pragma once

#include "synovia/contact/contact_surface.hpp"

#include <cmath>
#include <vector>

namespace synovia
{

/// A point that looks for a surface, along its unit normal and against it.
struct SearchQuery
{
   Point3 point;
   Point3 normal;
   /// The face to try first, as in SearchHit; if it is hit, no other is tried.
   int rank = -1;
   int face = -1;
};

/// What a query found.
struct SearchHit
{
   /// Rank that has the face, or -1 where nothing was found.
   int rank = -1;
   /// Number of the face in that rank's ContactSurface.
   int face = -1;
   /// Where on the face, in its reference coordinates.
   mfem::real_t xi = 0.0;
   mfem::real_t eta = 0.0;
   /// Signed distance along the normal: negative where the surfaces overlap.
   mfem::real_t distance = 0.0;
   /// Position of the point found in the reference configuration.
   Point3 reference{{0.0, 0.0, 0.0}};
   /// Outward unit normal of the surface there, in the reference configuration.
   Point3 normal{{0.0, 0.0, 0.0}};

   bool Found() const { return rank >= 0; }
   /// Becomes @a other if that was found, and nearer than this.
   void TakeNearer(const SearchHit &other)
   {
      if (other.Found() &&
          (!Found() || std::abs(other.distance) < std::abs(distance)))
      {
         *this = other;
      }
   }
};

/// Degrees of freedom of a face, on whichever rank it lives.
struct FaceDofs
{
   mfem::Geometry::Type geometry;
   /// Global true dofs, those of the displacement node by node (3 a node).
   std::vector<HYPRE_BigInt> displacement;
   std::vector<HYPRE_BigInt> pressure;
   /// Global numbers of the surface's vertices; see SurfaceVertices.
   std::vector<HYPRE_BigInt> vertices;
};

/// Of a face of this rank.
FaceDofs GetFaceDofs(const ContactSurface &surface, int face);

/// Finds where normals hit a surface that is split over ranks in any way.
///
/// A face counts as hit where it turns towards the query (its normal against
/// the query's) and is within the radius, on either side; the nearest hit is
/// taken, unless the query names a face. Ranks send their queries to those
/// ranks only whose boxes they meet.
class SurfaceSearch
{
public:
   /// Collective. Borrows @a surface in its current configuration; a surface
   /// that moves needs a new search.
   SurfaceSearch(const ContactSurface &surface, mfem::real_t radius);

   /// Collective; a rank may ask nothing. Hits in the order of the queries.
   std::vector<SearchHit> Find(const std::vector<SearchQuery> &queries) const;

   /// Collective. The dofs of the faces (rank, number) asked for, in order.
   std::vector<FaceDofs>
   GetFaceDofs(const std::vector<std::pair<int, int>> &faces) const;

private:
   SearchHit FindLocal(const SearchQuery &query) const;
   SearchHit HitFace(const SearchQuery &query, int face) const;
   /// Sends each rank the queries that are listed for it; nearest hits.
   std::vector<SearchHit>
   AskRanks(const std::vector<SearchQuery> &queries,
            const std::vector<std::vector<int>> &asked) const;
   const ContactSurface &surface;
   mfem::real_t radius;
   MPI_Comm comm;
   int size;
   int rank;
   /// Boxes of this rank's faces, and of all of each rank's.
   BoundingVolumeTree faces;
   BoundingVolumeTree ranks;
};

/// Whether a hit at @a distance is on the face that is expected at another one,
/// of this @a size (lengths): one that is farther away is of another part of
/// the source, in between.
inline bool IsExpectedHit(mfem::real_t distance, mfem::real_t expected,
                          mfem::real_t size)
{
   return std::abs(distance - expected) <= 0.5 * size;
}

} // namespace synovia
