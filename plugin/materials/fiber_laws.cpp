#include "synovia/materials/fiber_laws.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/text.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
// Written such that a NaN does not pass either.
void Verify(bool good, const std::string &name, real_t value,
            const std::string &must)
{
   if (!good)
   {
      throw Error(name + " of a fiber is " + ToText(value) + "; it must be " +
                  must);
   }
}
} // namespace

ExponentialPowerFiber::ExponentialPowerFiber(real_t xi_, real_t alpha_,
                                             real_t beta_,
                                             const MaterialFrame &frame)
   : FiberSolid(frame), xi(xi_), alpha(alpha_), beta(beta_)
{
   Verify(xi > 0.0, "xi", xi, "positive");
   Verify(alpha >= 0.0, "alpha", alpha, "0 or positive");
   Verify(beta >= 2.0, "beta", beta, "at least 2");
}

NeoHookeanFiber::NeoHookeanFiber(real_t mu_, const MaterialFrame &frame)
   : FiberSolid(frame), mu(mu_)
{
   Verify(mu > 0.0, "mu", mu, "positive");
}

PowerLinearFiber::PowerLinearFiber(real_t young_, real_t straight, real_t beta_,
                                   const MaterialFrame &frame)
   : FiberSolid(frame), young(young_), straight_square(straight * straight),
     beta(beta_)
{
   Verify(young > 0.0, "Young's modulus", young, "positive");
   Verify(straight > 1.0, "the stretch of the straight state", straight,
          "above 1");
   Verify(beta >= 2.0, "beta", beta, "at least 2");
   const real_t excess = straight_square - 1.0;
   xi = 0.25 * young / (beta - 1.0) * std::pow(straight_square, -1.5) *
        std::pow(excess, 2.0 - beta);
   offset = xi * std::pow(excess, beta - 1.0) + 0.5 * young / straight;
}

} // namespace synovia
