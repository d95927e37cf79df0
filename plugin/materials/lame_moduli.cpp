#include "synovia/materials/lame_moduli.hpp"
#include "synovia/materials/law_description.hpp"

namespace synovia
{

using namespace mfem;

LameModuli::LameModuli(real_t young, real_t poisson)
{
   YoungsModulus().Verify(young);
   PoissonsRatio().Verify(poisson);
   lambda = young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
   mu = young / (2.0 * (1.0 + poisson));
}

} // namespace synovia
