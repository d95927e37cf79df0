#pragma once

#include "mfem.hpp"

#include <memory>

namespace synovia
{

/// P_r^T A P_c of a matrix on local dofs. hypre's product of two matrices,
/// twice, takes a fifth of the time of its product of three, which MFEM's
/// ParallelAssemble() uses; on one rank a copy will do. Collective.
std::unique_ptr<mfem::HypreParMatrix>
SumShared(mfem::ParFiniteElementSpace &row_space,
          mfem::ParFiniteElementSpace &column_space, mfem::SparseMatrix &local);

} // namespace synovia
