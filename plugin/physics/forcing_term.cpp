#include "synovia/physics/forcing_term.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

real_t ForcingTerm::Next(real_t norm)
{
   real_t term = curvature * norm;
   if (last_norm > 0.0)
   {
      const real_t fall = norm / last_norm;
      term = factor * fall * fall;
   }
   last_norm = norm;
   return std::min(largest, term);
}

} // namespace synovia
