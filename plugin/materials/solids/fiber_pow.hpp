#pragma once

#include "synovia/materials/fiber_solid.hpp"

#include <cmath>

namespace synovia
{

/// Psi = xi (I_n - 1)^beta.
class FiberPow : public FiberSolid<FiberPow>
{
public:
   static LawDescription Describe()
   {
      return DescribeFibers(
         "fiber_pow",
         "fibers with a power law in tension, slack in compression",
         {{"ksi",
           "stress",
           "the modulus ksi of the fibers",
           NumberRange::Positive(),
           {}},
          {"beta",
           "",
           "the exponent beta of the fibers",
           NumberRange::AtLeast(2.0),
           {}}});
   }

   explicit FiberPow(const LawArguments &from)
      : FiberPow(from["ksi"], from["beta"], FiberDirection(from))
   {
   }
   /// @a xi is a stress. Throws Error if they are out of range.
   FiberPow(mfem::real_t xi_, mfem::real_t beta_,
            const FiberDirection &direction_)
      : FiberSolid(direction_), xi(xi_), beta(beta_)
   {
      Describe().Verify({xi, beta});
   }

   mfem::real_t Threshold() const override { return 1.0; }
   template <typename T>
   T EnergyDerivative(const T &square) const
   {
      using std::pow;
      return xi * beta * pow(square - 1.0, beta - 1.0);
   }

private:
   mfem::real_t xi;
   mfem::real_t beta;
};

} // namespace synovia
