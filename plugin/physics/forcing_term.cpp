#include "synovia/physics/forcing_term.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

real_t ForcingTerm::Next(real_t norm)
{
   constexpr real_t most = 1e-2;
   constexpr real_t safety = 0.9;
   real_t term = most;
   if (last_norm > 0.0)
   {
      const real_t fall = norm / last_norm;
      term = std::min(most, safety * fall * fall);
   }
   last_norm = norm;
   return term;
}

} // namespace synovia
