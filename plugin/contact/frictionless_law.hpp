#pragma once

#include "mfem.hpp"

namespace synovia
{

/// The law of frictionless biphasic contact between two surfaces (Guo & Spilker
/// 2014, equations 10 to 13): a normal traction that is compressive and acts on
/// both, and a relative flux out of the source that goes into the destination.
struct FrictionlessLaw
{
   /// lambda + eta g (stress), negative in compression.
   static mfem::real_t Traction(mfem::real_t multiplier, mfem::real_t penalty,
                                mfem::real_t gap)
   {
      return multiplier + penalty * gap;
   }
   /// Surfaces bear no tension.
   static bool Bears(mfem::real_t traction) { return traction < 0.0; }
   /// mu + eta_p (p_A - p_B) (length / time)
   static mfem::real_t Flux(mfem::real_t multiplier, mfem::real_t penalty,
                            mfem::real_t jump)
   {
      return multiplier + penalty * jump;
   }
};

} // namespace synovia
