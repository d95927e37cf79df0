#pragma once

#include "synovia/materials/fiber_solid.hpp"

#include <cmath>

namespace synovia
{

/// Psi = xi/2 (ln(l / lambda_0))^2 with the stretch l = sqrt(I_n), where
/// l > lambda_0.
class FiberNaturalNh : public FiberSolid<FiberNaturalNh>
{
public:
   static LawDescription Describe()
   {
      return DescribeFibers(
         "fiber_natural_nh",
         "fibers linear in the logarithmic strain, slack in compression",
         {{"ksi",
           "stress",
           "the modulus ksi of the fibers",
           NumberRange::Positive(),
           {}},
          {"lam0", "", "the stretch lam0 at which the fibers are taut",
           NumberRange::AtLeast(1.0), 1.0}});
   }

   explicit FiberNaturalNh(const LawArguments &from)
      : FiberNaturalNh(from["ksi"], from["lam0"], FiberDirection(from))
   {
   }
   /// @a xi is a stress. Throws Error if they are out of range.
   FiberNaturalNh(mfem::real_t xi_, mfem::real_t taut_,
                  const FiberDirection &direction_)
      : FiberSolid(direction_), xi(xi_), taut_square(taut_ * taut_)
   {
      Describe().Verify({xi, taut_});
   }

   mfem::real_t Threshold() const override { return taut_square; }
   template <typename T>
   T EnergyDerivative(const T &square) const
   {
      using std::log;
      return (0.25 * xi) * log(square / taut_square) / square;
   }

private:
   mfem::real_t xi;
   mfem::real_t taut_square;
};

} // namespace synovia
