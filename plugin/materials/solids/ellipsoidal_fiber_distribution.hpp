#pragma once

#include "synovia/materials/fiber_distribution.hpp"
#include "synovia/materials/law_arguments.hpp"
#include "synovia/materials/law_description.hpp"

namespace synovia
{

/// Fibers in all directions n with the energy, per undeformed volume and solid
/// angle,
///
///     Psi = xi(n) (I_n - 1)^beta(n),  1/xi(n)^2 = sum (n_i / xi_i)^2,
///
/// and beta(n) likewise, with components along r, theta and z (Ateshian, Rajan,
/// Chahine, Canal & Hung, J Biomech Eng 131(6):061003, 2009). Summed up over
/// the whole sphere: the energy of all directions is 4 pi times that of one.
class EllipsoidalFiberDistribution : public FiberDistribution
{
public:
   static LawDescription Describe();

   explicit EllipsoidalFiberDistribution(const LawArguments &from);
   /// @a beta at least 2, @a xi (stress) positive, along r, theta, z. Throws
   /// Error if they are out of range. Borrows @a frame.
   EllipsoidalFiberDistribution(const Point3 &beta, const Point3 &xi,
                                const MaterialFrame &frame);

protected:
   mfem::real_t Threshold() const override { return 1.0; }
   FiberEnergy::Derivatives Differentiate(int direction,
                                          mfem::real_t square) const override;

private:
   /// Of a direction.
   struct PowerLaw
   {
      mfem::real_t beta;
      mfem::real_t xi;
   };

   EllipsoidalFiberDistribution(const std::vector<WeightedDirection> &rule,
                                const Point3 &beta, const Point3 &xi,
                                const MaterialFrame &frame);

   std::vector<PowerLaw> powers;
};

} // namespace synovia
