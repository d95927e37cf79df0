#pragma once

#include "mfem.hpp"

#include <vector>

namespace synovia
{

/// One mesh of several bodies that have no nodes in common, even where they
/// touch.
struct StackedBodies
{
   mfem::Mesh mesh;
   /// What has been added to the element attributes of each body, and to its
   /// boundary attributes, so that no two bodies share one.
   std::vector<int> region_offsets;
   std::vector<int> boundary_offsets;
};

/// Merges three-dimensional serial meshes, which it only looks at, in this
/// order: the elements of the first come first. Element types may be mixed. If
/// any of them is curved, the result has nodes of the highest order of all.
/// Throws Error if a body is not three-dimensional or is refined
/// non-conformingly, or if there are none.
StackedBodies StackBodies(const std::vector<const mfem::Mesh *> &bodies);

} // namespace synovia
