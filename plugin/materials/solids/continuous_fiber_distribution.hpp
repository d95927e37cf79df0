#pragma once

#include "synovia/materials/fiber_density.hpp"
#include "synovia/materials/fiber_distribution.hpp"
#include "synovia/materials/law_arguments.hpp"
#include "synovia/materials/law_description.hpp"

namespace synovia
{

/// Fibers of one law, as many in each direction as a density R(n) says: their
/// energies' mean,
///
///     Psi = int R(n) Psi_fiber(I_n) dA / int R(n) dA.
class ContinuousFiberDistribution : public FiberDistribution
{
public:
   static LawDescription Describe();

   explicit ContinuousFiberDistribution(const LawArguments &from);
   /// Throws Error if the energy of @a fibers depends on more than I_n, and if
   /// the density is out of range or too narrow for a distribution. Borrows
   /// @a fibers and @a frame, in whose axes the density is.
   ContinuousFiberDistribution(const FiberEnergy &fibers,
                               const FiberDensity &density,
                               const MaterialFrame &frame);

protected:
   mfem::real_t Threshold() const override { return fibers.Threshold(); }
   FiberEnergy::Derivatives Differentiate(int,
                                          mfem::real_t square) const override
   {
      return fibers.Differentiate(square);
   }

private:
   const FiberEnergy &fibers;
};

} // namespace synovia
