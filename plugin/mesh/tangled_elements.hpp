#pragma once

#include "mfem.hpp"

#include "synovia/mesh/named_mesh.hpp"

#include <vector>

namespace synovia
{

/// Those of the @a elements whose Jacobian determinant is zero or negative at
/// one of JacobianPoints(), in the order given.
std::vector<int> TangledElements(mfem::Mesh &mesh,
                                 const std::vector<int> &elements);

/// Collective. Throws Error on all ranks if an element is tangled. Each rank
/// looks at all elements of its @a mesh, which have these @a numbers. The text
/// gives the number of tangled elements and of the first one its number, its
/// region and its center.
void ThrowIfTangled(MPI_Comm comm, mfem::Mesh &mesh,
                    const std::vector<long long> &numbers,
                    const NameTable &regions);

} // namespace synovia
