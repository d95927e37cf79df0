#pragma once

#include "synovia/mesh/named_mesh.hpp"

#include <vector>

namespace synovia
{

/// Collective. The values of all dofs in an order that does not depend on the
/// ranks, on rank 0; nothing on the others.
std::vector<double> GatherInOrder(const NamedMesh &mesh,
                                  const mfem::ParFiniteElementSpace &space,
                                  const mfem::Vector &true_dofs);

} // namespace synovia
