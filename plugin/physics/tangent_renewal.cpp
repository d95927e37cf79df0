#include "synovia/physics/tangent_renewal.hpp"

namespace synovia
{

using namespace mfem;

bool TangentRenewal::IsDue(real_t norm)
{
   const bool is_last =
      last_norm > 0.0 && norm * (norm / last_norm) <= tuning.kept_tangent;
   last_norm = norm;
   return !is_last;
}

} // namespace synovia
