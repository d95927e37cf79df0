#pragma once

#include "mfem.hpp"

namespace synovia
{

/// Shapes and sizes of the elements of a mesh, over all ranks.
struct MeshQuality
{
   long long elements = 0;
   /// Scaled Jacobian of the worst element and of the one in the middle.
   mfem::real_t min_scaled_jacobian = 0.0;
   mfem::real_t median_scaled_jacobian = 0.0;
   /// Attribute and center of the worst element.
   int worst_attribute = 0;
   mfem::real_t worst_center[3] = {0.0, 0.0, 0.0};
   /// Lengths of the shortest and longest edge, curved ones measured straight.
   mfem::real_t shortest_edge = 0.0;
   mfem::real_t longest_edge = 0.0;
   mfem::real_t volume = 0.0;
};

/// Scaled Jacobian of each of this rank's elements of a three-dimensional mesh:
/// the volume that the three tangents at a corner span, over the product of
/// their lengths, as a fraction of that of the regular element; the least over
/// all corners. A curved element is looked at between the corners too. 1 is
/// perfect, 0 flat and below 0 tangled.
mfem::Vector ScaledJacobians(const mfem::Mesh &mesh);

/// Collective.
MeshQuality MeasureQuality(const mfem::ParMesh &mesh);

} // namespace synovia
