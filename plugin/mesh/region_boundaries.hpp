#pragma once

#include "mfem.hpp"

namespace synovia
{

/// Attributes of the boundary elements of any rank behind which there is an
/// element with one of the @a regions' attributes, ascending. Collective.
mfem::Array<int> BoundariesOf(const mfem::ParMesh &mesh,
                              const mfem::Array<int> &regions);

/// Those of them behind which there is no other region: faces without a name
/// may share an attribute. Collective.
mfem::Array<int> BoundariesOnlyOf(const mfem::ParMesh &mesh,
                                  const mfem::Array<int> &regions);

} // namespace synovia
