#include "synovia/materials/solids/fiber_exp_pow.hpp"

namespace synovia
{

using namespace mfem;

LawDescription FiberExpPow::Describe()
{
   const NumberRange not_negative = NumberRange::AtLeast(0.0);
   return DescribeFibers(
      "fiber_exp_pow",
      "fibers with an exponential and power law in tension, slack in "
      "compression",
      {{"alpha", "", "the coefficient alpha of the fibers", not_negative, {}},
       {"beta",
        "",
        "the exponent beta of the fibers",
        NumberRange::AtLeast(2.0),
        {}},
       {"ksi",
        "stress",
        "the modulus ksi of the fibers",
        NumberRange::Positive(),
        {}},
       {"mu", "stress", "the shear modulus mu of the fibers", not_negative,
        0.0},
       {"lam0", "", "the stretch lam0 at which the fibers are taut",
        NumberRange::AtLeast(1.0), 1.0}});
}

FiberExpPow::FiberExpPow(const LawArguments &from)
   : FiberExpPow(from["alpha"], from["beta"], from["ksi"], from["mu"],
                 from["lam0"], FiberDirection(from))
{
}

FiberExpPow::FiberExpPow(real_t alpha_, real_t beta_, real_t xi_, real_t mu_,
                         real_t taut, const FiberDirection &direction_)
   : FiberSolid(direction_), alpha(alpha_), beta(beta_), xi(xi_), mu(mu_),
     taut_square(taut * taut)
{
   Describe().Verify({alpha, beta, xi, mu, taut});
}

} // namespace synovia
