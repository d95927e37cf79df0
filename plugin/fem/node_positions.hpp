#pragma once

#include "mfem.hpp"

namespace synovia
{

/// Where the nodes of a space of displacements are in the mesh, as true dofs.
/// Collective.
mfem::Vector NodePositions(mfem::ParFiniteElementSpace &space);

} // namespace synovia
