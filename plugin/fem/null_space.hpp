#pragma once

#include "mfem.hpp"

#include <vector>

namespace synovia
{

/// Vectors x != 0 with A x = 0 of a symmetric positive semi-definite matrix
/// with entries of about 1, that span all of them; each has largest entry 1.
/// Pivots up to @a tolerance count as zero.
std::vector<mfem::Vector> NullSpace(mfem::DenseMatrix a,
                                    mfem::real_t tolerance = 1e-9);

/// Columns that, with the null space, span the whole space as unit vectors.
mfem::Array<int> IndependentColumns(mfem::DenseMatrix a,
                                    mfem::real_t tolerance = 1e-9);

} // namespace synovia
