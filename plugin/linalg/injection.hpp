#pragma once

#include "mfem.hpp"

#include <memory>

namespace synovia
{

/// Picks @a rows, local numbers, out of those of a distributed matrix: the
/// matrix's rows x picked ones, with one entry in each column. Its transpose
/// times a vector of all rows has the picked ones. Collective.
std::unique_ptr<mfem::HypreParMatrix>
Injection(const mfem::HypreParMatrix &matrix, const mfem::Array<int> &rows);

} // namespace synovia
