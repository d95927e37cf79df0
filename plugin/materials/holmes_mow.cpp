#include "synovia/materials/holmes_mow.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/text.hpp"

namespace synovia
{

HolmesMow::HolmesMow(mfem::real_t young, mfem::real_t poisson,
                     mfem::real_t beta_)
   : moduli(young, poisson), beta(beta_)
{
   if (!(beta > 0.0))
   {
      throw Error("beta of a Holmes-Mow solid is " + ToText(beta) +
                  "; it must be positive");
   }
}

} // namespace synovia
