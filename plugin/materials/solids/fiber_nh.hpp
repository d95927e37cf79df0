#pragma once

#include "synovia/materials/fiber_solid.hpp"

namespace synovia
{

/// Psi = mu/4 (I_n - 1)^2.
class FiberNh : public FiberSolid<FiberNh>
{
public:
   static LawDescription Describe()
   {
      return DescribeFibers(
         "fiber_nh", "fibers, neo-Hookean in tension, slack in compression",
         {{"mu",
           "stress",
           "the modulus mu of the fibers",
           NumberRange::Positive(),
           {}}});
   }

   explicit FiberNh(const LawArguments &from)
      : FiberNh(from["mu"], FiberDirection(from))
   {
   }
   /// @a mu (stress): Young's modulus along the fibers is 2 mu at small
   /// strains. Throws Error if it is out of range.
   FiberNh(mfem::real_t mu_, const FiberDirection &direction_)
      : FiberSolid(direction_), mu(mu_)
   {
      Describe().Verify({mu});
   }

   mfem::real_t Threshold() const override { return 1.0; }
   template <typename T>
   T EnergyDerivative(const T &square) const
   {
      return (0.5 * mu) * (square - 1.0);
   }

private:
   mfem::real_t mu;
};

} // namespace synovia
