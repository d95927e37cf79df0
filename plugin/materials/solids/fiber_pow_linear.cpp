#include "synovia/materials/solids/fiber_pow_linear.hpp"

namespace synovia
{

using namespace mfem;

LawDescription FiberPowLinear::Describe()
{
   return DescribeFibers(
      "fiber_pow_linear",
      "fibers with a power law that becomes linear, slack in compression",
      {{"E",
        "stress",
        "Young's modulus of the straight fibers",
        NumberRange::Positive(),
        {}},
       {"lam0",
        "",
        "the stretch lam0 at which the fibers are straight",
        NumberRange::Above(1.0),
        {}},
       {"beta",
        "",
        "the exponent beta of the fibers",
        NumberRange::AtLeast(2.0),
        {}}});
}

FiberPowLinear::FiberPowLinear(const LawArguments &from)
   : FiberPowLinear(from["E"], from["lam0"], from["beta"], FiberDirection(from))
{
}

FiberPowLinear::FiberPowLinear(real_t young_, real_t straight, real_t beta_,
                               const FiberDirection &direction_)
   : FiberSolid(direction_), young(young_),
     straight_square(straight * straight), beta(beta_)
{
   Describe().Verify({young, straight, beta});
   const real_t excess = straight_square - 1.0;
   xi = 0.25 * young / (beta - 1.0) * std::pow(straight_square, -1.5) *
        std::pow(excess, 2.0 - beta);
   offset = xi * std::pow(excess, beta - 1.0) + 0.5 * young / straight;
}

} // namespace synovia
