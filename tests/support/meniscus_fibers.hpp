#pragma once

#include "synovia/materials/solids/transversely_isotropic.hpp"

namespace synovia
{

/// The paper's meniscus (section 3.3), in MPa; its shear modulus is ours.
inline FiberConstants MeniscusFibers()
{
   FiberConstants constants;
   constants.young_r = 0.075;
   constants.young_theta = 100.0;
   constants.poisson_rtheta = 0.0015;
   constants.poisson_rz = 0.5;
   constants.shear_rtheta = 0.05;
   return constants;
}

} // namespace synovia
