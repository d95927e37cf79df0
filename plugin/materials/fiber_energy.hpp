#pragma once

#include "synovia/materials/tensor3.hpp"

namespace synovia
{

/// The energy Psi(I_n) of fibers, per undeformed volume, as a function of the
/// square of their stretch, I_n = n_0 . C n_0.
class FiberEnergy
{
public:
   /// Psi' and Psi''.
   struct Derivatives
   {
      mfem::real_t first;
      mfem::real_t second;
   };

   virtual ~FiberEnergy() = default;

   /// I_0: fibers resist where I_n is larger.
   virtual mfem::real_t Threshold() const = 0;
   /// Where I_n = @a square is above the threshold.
   virtual Derivatives Differentiate(mfem::real_t square) const = 0;
   /// Whether the energy depends on I_n alone.
   virtual bool DependsOnStretchOnly() const { return true; }
};

/// Whether I_n = @a square is above @a threshold. Raises it to just above where
/// it is below by no more than round-off: undeformed fibers count as taut, and
/// powers of a negative or zero excess have no derivative.
template <typename T>
bool IsTaut(mfem::real_t threshold, T &square)
{
   constexpr mfem::real_t round_off = 1e-12;
   const mfem::real_t taut = threshold * (1.0 + round_off);
   if (square < taut && square > threshold * (1.0 - round_off))
   {
      // Keeps its derivatives.
      square = square + (taut - ValueOf(square));
   }
   return square > threshold;
}

} // namespace synovia
