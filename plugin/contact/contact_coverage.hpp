#pragma once

#include "mfem.hpp"

#include <array>
#include <memory>
#include <vector>

namespace synovia
{

/// The part of a destination face that the source covers.
struct FaceCoverage
{
   /// Number of the face in the destination's ContactSurface.
   int face = -1;
   /// int phi_j over that part for each vertex of the face (area).
   std::array<mfem::real_t, 4> area{{0.0, 0.0, 0.0, 0.0}};
};

/// Which parts of two surfaces see each other. Vectors have an entry for each
/// of this rank's vertices of the destination (SurfaceVertices), phi_j is its
/// shape function, and integrals run over what the source covers.
struct ContactCoverage
{
   /// Source vertices x destination vertices: int psi_k phi_j, area of source
   /// vertex k that destination vertex j covers.
   std::unique_ptr<mfem::HypreParMatrix> coverage;
   /// a_j = int phi_j (area), 0 where the vertex sees nothing.
   mfem::Vector area;
   /// The same of the vertex's own shape function, where phi_j is more than
   /// that (RimVertices) or less (BearingShares()).
   mfem::Vector own_area;
   /// int phi_j n, by component (area).
   std::array<mfem::Vector, 3> normal_area;
   /// Mean size of the destination faces around a vertex (length).
   mfem::Vector face_size;
   /// Of this rank's destination faces that hit.
   std::vector<FaceCoverage> face_coverage;

   /// Weighted gaps of round surfaces that touch at a point are a small part of
   /// the size of the faces around it (length).
   mfem::real_t GrazingGap(int vertex) const
   {
      return 0.05 * face_size[vertex];
   }
};

} // namespace synovia
