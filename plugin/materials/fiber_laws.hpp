#pragma once

#include "synovia/materials/fiber_solid.hpp"

namespace synovia
{

/// Psi = xi/(alpha beta) (exp(alpha (I_n - 1)^beta) - 1), and its limit
/// xi/beta (I_n - 1)^beta for alpha = 0 (Ateshian, Rajan, Chahine, Canal &
/// Hung, J Biomech Eng 131(6):061003, 2009).
class ExponentialPowerFiber : public FiberSolid<ExponentialPowerFiber>
{
public:
   /// @a xi > 0 (stress), @a alpha >= 0, @a beta >= 2. Throws Error otherwise.
   /// Borrows @a frame.
   ExponentialPowerFiber(mfem::real_t xi, mfem::real_t alpha, mfem::real_t beta,
                         const MaterialFrame &frame);

   mfem::real_t Threshold() const { return 1.0; }
   template <typename T>
   T EnergyDerivative(const T &square) const
   {
      using std::exp;
      using std::pow;
      const T excess = square - 1.0;
      const T stress = xi * pow(excess, beta - 1.0);
      return alpha > 0.0 ? stress * exp(alpha * pow(excess, beta)) : stress;
   }

private:
   mfem::real_t xi;
   mfem::real_t alpha;
   mfem::real_t beta;
};

/// Psi = mu/4 (I_n - 1)^2.
class NeoHookeanFiber : public FiberSolid<NeoHookeanFiber>
{
public:
   /// @a mu > 0 (stress): Young's modulus along the fibers is 2 mu at small
   /// strains. Throws Error otherwise. Borrows @a frame.
   NeoHookeanFiber(mfem::real_t mu, const MaterialFrame &frame);

   mfem::real_t Threshold() const { return 1.0; }
   template <typename T>
   T EnergyDerivative(const T &square) const
   {
      return (0.5 * mu) * (square - 1.0);
   }

private:
   mfem::real_t mu;
};

/// A power law up to the stretch lambda_0, and then linear between stress and
/// stretch, with continuous stress and stiffness:
///
///     Psi' = xi (I_n - 1)^(beta - 1)          for 1 < I_n < lambda_0^2,
///     Psi' = b - E / (2 sqrt(I_n))            beyond.
class PowerLinearFiber : public FiberSolid<PowerLinearFiber>
{
public:
   /// Young's modulus @a young > 0 of the straight fibers (stress),
   /// @a straight = lambda_0 > 1, @a beta >= 2. Throws Error otherwise. Borrows
   /// @a frame.
   PowerLinearFiber(mfem::real_t young, mfem::real_t straight,
                    mfem::real_t beta, const MaterialFrame &frame);

   mfem::real_t Threshold() const { return 1.0; }
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
