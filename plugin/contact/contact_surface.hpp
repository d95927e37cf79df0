#pragma once

#include "synovia/contact/face_polynomial.hpp"
#include "synovia/contact/surface_vertices.hpp"
#include "synovia/general/bounding_volume_tree.hpp"
#include "synovia/general/state_archive.hpp"

#include <string>
#include <vector>

namespace synovia
{

/// A boundary face of this rank with the displacement of its nodes: the current
/// position of its points is X(xi) + sum_k N_k(xi) u_k, kept as one polynomial
/// of the higher of the two orders.
class DeformedFace
{
public:
   /// @param spaces      borrowed, outlives the object
   /// @param surface     the vertices of the surface that the face belongs to
   /// @param element     number of the boundary element on this rank
   DeformedFace(BiphasicSpaces &spaces, const SurfaceVertices &surface,
                int element);

   /// Takes the nodal displacements from @a u (a grid function's local dofs).
   void SetDisplacement(const mfem::Vector &u);

   mfem::Geometry::Type GetGeometry() const { return geometry; }
   /// Local dofs of the face, node by node: x, y, z of node 0, then node 1, ...
   const mfem::Array<int> &DisplacementDofs() const { return u_dofs; }
   const mfem::Array<int> &PressureDofs() const { return p_dofs; }
   /// Local vertices, as SurfaceVertices numbers them.
   const mfem::Array<int> &Vertices() const { return vertices; }

   /// A point of the face in the reference and in the current configuration;
   /// normals point outwards.
   SurfacePoint Reference(const mfem::IntegrationPoint &ip) const
   {
      return reference(ip.x, ip.y);
   }
   SurfacePoint Current(const mfem::IntegrationPoint &ip) const
   {
      return current(ip.x, ip.y);
   }
   /// Both positions as functions of the reference coordinates.
   const FacePolynomial &ReferenceShape() const { return reference; }
   const FacePolynomial &CurrentShape() const { return current; }
   /// With the second derivatives of the current position.
   BentSurfacePoint CurrentBent(const mfem::IntegrationPoint &ip) const
   {
      return current.Bent(ip.x, ip.y);
   }

   /// A box around the current face, with room for its curvature.
   Box CurrentBox() const;

private:
   mfem::Geometry::Type geometry;
   const mfem::FiniteElement *element;
   mfem::Array<int> u_dofs;
   mfem::Array<int> p_dofs;
   mfem::Array<int> vertices;
   FacePolynomial reference;
   FacePolynomial current;
   // Displacement dofs x powers of the polynomials.
   mfem::DenseMatrix powers_from_displacement;
};

/// The faces of this rank that belong to one side of a contact pair. A rank may
/// have none.
class ContactSurface
{
public:
   /// Borrows @a spaces; @a boundary lists the attributes. Collective.
   ContactSurface(BiphasicSpaces &spaces, const mfem::Array<int> &boundary);

   /// Moves the faces to the displacement @a u (true dofs). Collective.
   void SetDisplacement(const mfem::Vector &u);

   /// An archive's field of the multiplier that is @a values at the vertices,
   /// and zero off the surface. Collective.
   void Archive(StateArchive &archive, const std::string &name,
                mfem::Vector &values) const;

   /// The shape functions of the vertices of a face at one of its points.
   void GetVertexShapes(int face, const mfem::IntegrationPoint &ip,
                        mfem::Vector &shapes) const;

   const std::vector<DeformedFace> &Faces() const { return faces; }
   const SurfaceVertices &Vertices() const { return vertices; }
   BiphasicSpaces &Spaces() const { return spaces; }
   /// The attributes.
   const mfem::Array<int> &Boundary() const { return boundary; }

   /// True dofs of the surface, ascending.
   const mfem::Array<int> &DisplacementTrueDofs() const { return u_tdofs; }
   const mfem::Array<int> &PressureTrueDofs() const { return p_tdofs; }

private:
   BiphasicSpaces &spaces;
   mfem::Array<int> boundary;
   SurfaceVertices vertices;
   std::vector<DeformedFace> faces;
   mfem::Array<int> u_tdofs;
   mfem::Array<int> p_tdofs;
};

} // namespace synovia
