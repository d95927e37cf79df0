#pragma once

#include "synovia/contact/contact_surface.hpp"

#include <array>
#include <memory>
#include <vector>

namespace synovia
{

/// Normals of a deformed surface that are continuous where it is faceted: at a
/// vertex the mean of the normals of the faces around it, weighted by their
/// areas, and linear (bilinear) in between. Ends of the surface, such as planes
/// of symmetry, have faces on one side only.
class SurfaceNormals
{
public:
   /// Borrows @a surface. Update() comes first.
   explicit SurfaceNormals(const ContactSurface &surface);

   /// Brings the normals to the surface's current configuration. Collective.
   void Update();

   /// Outward unit normals at the vertices of a face, in their order.
   const std::array<Point3, 4> &AtVertices(int face) const
   {
      return normals[face];
   }

   /// Numbers of the rows of Derivative() that belong to a local vertex: this
   /// one and the two that follow.
   HYPRE_BigInt Row(int vertex) const;
   /// First and last plus one of this rank's rows; as many on all ranks.
   HYPRE_BigInt *RowOffsets() const { return offsets.data(); }
   HYPRE_BigInt GlobalRows() const;

   /// Change of the vertices' unit normals with the displacement: three rows,
   /// by component, for each vertex of the surface x displacement true
   /// dofs (1 / length). Collective.
   std::unique_ptr<mfem::HypreParMatrix> Derivative() const;

private:
   const ContactSurface &surface;
   // hypre takes it without const.
   mutable std::array<HYPRE_BigInt, 2> offsets;
   std::vector<std::array<Point3, 4>> normals;
   /// Sums of area vectors at the vertices of faces, before they were made unit
   /// vectors.
   std::vector<std::array<mfem::real_t, 4>> lengths;
};

/// I - n n^T for a unit vector n: applied to @a v.
inline Point3 Across(const Point3 &n, const Point3 &v)
{
   return Sum(v, -Dot(n, v), n);
}

} // namespace synovia
