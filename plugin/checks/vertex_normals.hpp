#pragma once

#include "synovia/fem/biphasic_spaces.hpp"
#include "synovia/general/point3.hpp"

#include <vector>

namespace synovia
{

/// The corners of a face, with the normals of its surface there.
struct FaceCorners
{
   std::vector<Point3> points;
   std::vector<Point3> normals;
   /// Whether the surface goes on around it, without an edge.
   std::vector<bool> smooth;

   Point3 Center() const;
   Point3 AreaVector() const;
   /// The surface's normal at a corner, or the face's own at a sharp edge.
   Point3 Normal(size_t corner) const;
};

/// The normals of a surface at its vertices: the mean of its faces', by area.
class VertexNormals
{
public:
   /// Borrows @a spaces; takes the boundaries with these attributes as one
   /// surface. Collective.
   VertexNormals(BiphasicSpaces &spaces, const mfem::Array<int> &surfaces);

   /// Of a boundary element of this rank on the surface.
   FaceCorners Corners(int boundary_element) const;

private:
   BiphasicSpaces &spaces;
   /// By dof of the multipliers, three each.
   std::vector<Point3> normals;
   /// The least cosine of a face's normal to it.
   mfem::Array<mfem::real_t> least_cosine;
   /// The sum of the faces' angles.
   mfem::Array<mfem::real_t> angle;
};

} // namespace synovia
