#pragma once

#include "synovia/mesh/triangulated_surface.hpp"

namespace synovia
{

/// The outward normals of surfaces where they are nearest to points. At the
/// vertices they are the means of the faces' by area, as if the surfaces had no
/// edges, and linear in between.
class NearestNormals
{
public:
   /// Of the boundaries with these attributes, which must have faces.
   /// Collective.
   NearestNormals(mfem::ParMesh &mesh, const mfem::Array<int> &boundaries);

   /// The unit normal where the surfaces are nearest to @a point.
   Point3 operator()(const Point3 &point) const;

private:
   TriangulatedSurface surface;
   /// Of the corners of its triangles.
   std::vector<Triangle> normals;
};

} // namespace synovia
