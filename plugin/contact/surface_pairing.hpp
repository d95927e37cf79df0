#pragma once

#include "synovia/contact/face_halo.hpp"
#include "synovia/contact/gap_operators.hpp"
#include "synovia/contact/segmentation.hpp"
#include "synovia/contact/surface_normals.hpp"

#include <vector>

namespace synovia
{

/// Of each destination face, the parts of its vertices' multipliers that it
/// bears.
using FaceShares = std::vector<std::array<mfem::real_t, 4>>;

/// Of one vertex of a face; everything if there are no shares.
inline mfem::real_t ShareOf(const FaceShares &shares, int face, int vertex)
{
   return shares.empty() ? 1.0 : shares[face][vertex];
}

/// A quadrature point of the destination and the point of the source that its
/// current normal n hits: x_A(xi) = x_B + gap n.
struct PairedPoint
{
   /// Number of the destination face, where on it, and the reference area that
   /// the point stands for.
   int face = -1;
   mfem::IntegrationPoint ip;
   mfem::real_t area = 0.0;
   /// Size of the source face that it was made for (length).
   mfem::real_t size = 0.0;
   /// The source face that is hit, and its number in the halo; the point counts
   /// where that is not negative.
   FaceName name{-1, -1};
   int source = -1;
   mfem::IntegrationPoint hit;
   /// The same of the segment that the point was made for.
   FaceName first_name{-1, -1};
   mfem::IntegrationPoint first_hit;
   /// Signed distance along the normal: negative where the surfaces overlap.
   mfem::real_t gap = 0.0;

   bool Counts() const { return source >= 0; }
};

/// Which points of two deforming surfaces see each other.
///
/// Quadrature points and weights are material points of the destination, made
/// segment by segment (SegmentSurface()) and kept until they are made anew.
/// What they hit follows the deformation: along the normals of SurfaceNormals,
/// from face to face. A point that leaves the rim of the source stays on the
/// continuation of the nearest face, as long as that is near, so that
/// iterations see no jumps; the next segmentation leaves it out.
class SurfacePairing
{
public:
   /// Borrows both surfaces. @a options.normal must be the destination's.
   SurfacePairing(const ContactSurface &source,
                  const ContactSurface &destination, const GapOptions &options);

   /// Makes points anew in the surfaces' current configuration. Faces bear
   /// @a shares, everything if there are none. Collective.
   void Segment(const FaceShares &shares = FaceShares());
   /// Finds what the points hit now that the surfaces have moved; says whether
   /// any left the source, so that there may be fewer. Collective.
   bool Follow();
   /// Remembers what the points hit now, for GoBack().
   void Remember();
   /// Lets the points hit what they did at the last Remember(), since when
   /// there was no Segment(): Follow(), which comes next, depends on the way.
   /// Says whether there may have been fewer. Collective.
   bool GoBack();
   /// Whether points hit other faces than those that they were made for, or
   /// none, so that segments don't follow the source's faces any more.
   /// Collective.
   bool HasDrifted() const;
   /// How far points that touch the source, or nearly so, have slid on it at
   /// most since they were made, as a part of its faces' size; infinite where
   /// there are none. Collective.
   mfem::real_t Slid() const;

   const ContactSurface &Source() const { return source; }
   const ContactSurface &Destination() const { return destination; }
   /// Of the last Segment().
   const FaceShares &Shares() const { return shares; }
   /// Face by face of the destination.
   const std::vector<PairedPoint> &Points() const { return points; }
   const SurfaceNormals &Normals() const { return normals; }
   FaceHalo &SourceFaces() { return halo; }
   const FaceHalo &SourceFaces() const { return halo; }

private:
   /// Where a normal goes through a face or its continuation.
   struct Landing
   {
      int face = -1;
      mfem::IntegrationPoint ip;
      mfem::real_t gap = 0.0;
      /// How far that is outside of the face, in reference coordinates.
      mfem::real_t outside = mfem::infinity();
   };

   SearchQuery Look(const PairedPoint &point) const;
   /// Solves x_A(xi) = x_B + gap n on a face, from where @a start is; @a start
   /// itself if that leads too far away.
   Landing Land(const SearchQuery &query, int face, const Landing &start) const;
   /// Goes from face to face of the halo to where the point's normal leads;
   /// says whether that is on a face, not beyond the rim.
   bool Walk(PairedPoint &point) const;
   /// Looks for faces that aren't in the halo.
   void FindOtherFaces(const std::vector<int> &leaving);
   void AskForFaces(const SurfaceSearch &search);
   void FindNeighbors();

   const ContactSurface &source;
   const ContactSurface &destination;
   GapOptions options;
   std::vector<PairedPoint> points;
   FaceShares shares;
   SurfaceNormals normals;
   FaceHalo halo;
   /// Of the halo's faces: names, and faces that share a vertex.
   std::vector<FaceName> names;
   std::vector<std::vector<int>> neighbors;
   bool drifted = false;
   /// At the last Remember().
   std::vector<PairedPoint> remembered_points;
   bool remembered_drift = false;
   /// Whether faces have been asked for since.
   bool asked_since = false;
};

/// The vector that SurfaceNormals give between the vertices, not of unit
/// length: @a shape are values of the shape functions of the vertices.
Point3 InterpolateNormal(const std::array<Point3, 4> &vertices,
                         const mfem::Vector &shape);

} // namespace synovia
