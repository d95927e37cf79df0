#include "synovia/materials/porous_neo_hookean.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/text.hpp"

namespace synovia
{

using namespace mfem;

PorousNeoHookean::PorousNeoHookean(real_t young, real_t solid_fraction_)
   : solid_fraction(solid_fraction_)
{
   if (!(young > 0.0))
   {
      throw Error("Young's modulus is " + ToText(young) +
                  "; it must be positive");
   }
   if (!(solid_fraction > 0.0 && solid_fraction < 1.0))
   {
      throw Error("the solid fraction is " + ToText(solid_fraction) +
                  "; it must lie between 0 and 1");
   }
   const real_t pores = 1.0 - solid_fraction;
   mu = young / 3.0 * (1.0 + 0.5 * pores * pores);
   // lambda from E = mu (3 lambda + 2 mu) / (lambda + mu).
   const real_t lambda = mu * (young - 2.0 * mu) / (3.0 * mu - young);
   aggregate = lambda + 2.0 * mu;
}

} // namespace synovia
