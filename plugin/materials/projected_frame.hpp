#pragma once

#include "synovia/materials/element_frame.hpp"
#include "synovia/mesh/named_mesh.hpp"

namespace synovia
{

/// Fibers along surfaces, such as those that split lines show: in each element
/// z is the outward normal of the surfaces where they are nearest to its
/// center, theta is along the projection of a given vector on their tangent
/// plane there, and r = theta x z.
class ProjectedFrame : public ElementFrame
{
public:
   /// @a direction has any length; throws Error if that is zero. The surfaces
   /// are the boundaries with these attributes, which must have faces.
   /// Collective.
   ProjectedFrame(NamedMesh &mesh, const mfem::Array<int> &boundaries,
                  const Point3 &direction);

   /// Along the normal nothing can be projected.
   std::string Validate(mfem::ElementTransformation &trans) const override;
};

} // namespace synovia
