#pragma once

#include "mfem.hpp"

namespace synovia
{

/// Green's strain (F^T F - I)/2 = sym(H) + H^T H/2 of a displacement gradient
/// H, 3 x 3, without loss of digits where it is small.
mfem::DenseMatrix GreenStrain(const mfem::DenseMatrix &gradient);

/// The logarithmic strain ln(stretch) along a direction in which Green's strain
/// is @a green; the least number that there is if nothing is left of the
/// stretch.
mfem::real_t LogarithmicStrain(mfem::real_t green);

} // namespace synovia
