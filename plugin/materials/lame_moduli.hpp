#pragma once

#include "mfem.hpp"

namespace synovia
{

/// The isotropic moduli of small strains (stress).
struct LameModuli
{
   /// From Young's modulus @a young > 0 and Poisson's ratio
   /// -1 < @a poisson < 0.5. Throws Error otherwise.
   LameModuli(mfem::real_t young, mfem::real_t poisson);

   mfem::real_t lambda;
   mfem::real_t mu;
   /// H_A = lambda + 2 mu
   mfem::real_t Aggregate() const { return lambda + 2.0 * mu; }
};

} // namespace synovia
