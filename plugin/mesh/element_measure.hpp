#pragma once

#include "mfem.hpp"

namespace synovia
{

/// Volume of an element or area of a face, curved ones included: the rule is
/// exact for the determinants of volumes.
mfem::real_t Measure(mfem::ElementTransformation &trans);

} // namespace synovia
