#pragma once

#include "mfem.hpp"

namespace synovia
{

/// Bytes of this rank's part of a matrix in memory, which a product with a
/// vector reads once; 0 for null.
double BytesOf(const mfem::HypreParMatrix *matrix);

/// Bytes of this rank's matrices that a V-cycle with a sweep each way reads,
/// at least: on each level the matrix for either sweep and for the residual,
/// and the interpolation either way. 0 before the set-up.
double BytesOfCycle(const mfem::HypreBoomerAMG &amg);

} // namespace synovia
