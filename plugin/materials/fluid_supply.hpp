#pragma once

#include "mfem.hpp"

namespace synovia
{

/// Fluid that vessels, which are not meshed, let into a body by Starling's law:
/// kp (pc - p) per volume and time, of the body as it is deformed.
struct FluidSupply
{
   /// kp, of the walls of the vessels in a volume (1 / (stress x time)); 0:
   /// there are none.
   mfem::real_t kp = 0.0;
   /// pc, in the vessels (stress).
   mfem::real_t pc = 0.0;

   bool Any() const { return kp != 0.0; }
   /// Where the fluid's pressure is @a p (1 / time).
   mfem::real_t Rate(mfem::real_t p) const { return kp * (pc - p); }
};

} // namespace synovia
