#include "synovia/physics/tangent_renewal.hpp"

namespace synovia
{

using namespace mfem;

bool TangentRenewal::IsDue(real_t norm)
{
   // With a tangent that is kept the residual falls in each iteration by a
   // factor at best, which is worth it where that is a large one.
   constexpr real_t least_fall = 0.1;
   const bool keeps = norm <= least_fall * last_norm &&
                      norm * (norm / last_norm) <= tuning.kept_tangent;
   last_norm = norm;
   return !keeps;
}

} // namespace synovia
