#pragma once

#include "mfem.hpp"

namespace synovia
{

/// Eigenvalues of a small symmetric matrix, ascending, by Jacobi's method;
/// MFEM's need LAPACK above 3 x 3. Not numbers if an entry isn't finite.
mfem::Vector SymmetricEigenvalues(mfem::DenseMatrix matrix);

} // namespace synovia
