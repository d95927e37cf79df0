#pragma once

#include "synovia/materials/fiber_solid.hpp"

#include <cmath>

namespace synovia
{

/// A power law up to the stretch lambda_0, and then linear between stress and
/// stretch, with continuous stress and stiffness:
///
///     Psi' = xi (I_n - 1)^(beta - 1)          for 1 < I_n < lambda_0^2,
///     Psi' = b - E / (2 sqrt(I_n))            beyond.
class FiberPowLinear : public FiberSolid<FiberPowLinear>
{
public:
   static LawDescription Describe();

   explicit FiberPowLinear(const LawArguments &from);
   /// Young's modulus of the straight fibers (stress), @a straight = lambda_0
   /// and @a beta. Throws Error if they are out of range.
   FiberPowLinear(mfem::real_t young, mfem::real_t straight, mfem::real_t beta,
                  const FiberDirection &direction);

   mfem::real_t Threshold() const override { return 1.0; }
   template <typename T>
   T EnergyDerivative(const T &square) const
   {
      using std::pow;
      using std::sqrt;
      if (square < straight_square)
      {
         return xi * pow(square - 1.0, beta - 1.0);
      }
      return offset - 0.5 * young / sqrt(square);
   }

private:
   mfem::real_t young;
   mfem::real_t straight_square;
   mfem::real_t beta;
   mfem::real_t xi;
   mfem::real_t offset;
};

} // namespace synovia
