#pragma once

#include "mfem.hpp"

#include <string>

namespace synovia
{

/// How two surfaces are tied. Zero means: derived from the bodies.
struct TieOptions
{
   /// How far the undeformed surfaces look for each other (length). Derived:
   /// half of the thickness of the thinner layer.
   mfem::real_t search_radius = 0.0;
   /// Largest difference of the displacements left (length). Derived: 1e-6 of
   /// the thickness of the thinner layer.
   mfem::real_t displacement_tolerance = 0.0;
   /// Largest difference of the fluid's pressures left, as a fraction of the
   /// peak pressure.
   mfem::real_t pressure_tolerance = 1e-4;
};

/// Throws Error that names the @a tie and the option which is out of range.
void Verify(const TieOptions &options, const std::string &tie);

} // namespace synovia
