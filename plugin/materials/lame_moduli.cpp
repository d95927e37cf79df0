#include "synovia/materials/lame_moduli.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/text.hpp"

namespace synovia
{

using namespace mfem;

LameModuli::LameModuli(real_t young, real_t poisson)
{
   if (!(young > 0.0))
   {
      throw Error("Young's modulus is " + ToText(young) +
                  "; it must be positive");
   }
   if (!(poisson > -1.0 && poisson < 0.5))
   {
      throw Error("Poisson's ratio is " + ToText(poisson) +
                  "; it is that of the drained solid and must lie between -1 "
                  "and 0.5");
   }
   lambda = young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
   mu = young / (2.0 * (1.0 + poisson));
}

} // namespace synovia
