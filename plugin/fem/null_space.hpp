#pragma once

#include "mfem.hpp"

#include <vector>

namespace synovia
{

/// Vectors x != 0 with A x = 0 of a symmetric positive semi-definite matrix
/// with entries of about 1, that span all of them; each has largest entry 1.
std::vector<mfem::Vector> NullSpace(const mfem::DenseMatrix &a);

} // namespace synovia
