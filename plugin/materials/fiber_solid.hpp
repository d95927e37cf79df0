#pragma once

#include "synovia/materials/differentiated_solid.hpp"
#include "synovia/materials/fiber_direction.hpp"
#include "synovia/materials/law_arguments.hpp"
#include "synovia/materials/law_description.hpp"

namespace synovia
{

/// Fibers along the axis theta of a frame: an energy Psi(I_n) of the square of
/// their stretch, I_n = n_0 . C n_0, that resists tension only:
///
///     P = 2 Psi'(I_n) (F n_0) (x) n_0 where I_n > I_0.
///
/// Where I_n is I_0 but for round-off they count as taut, so that the stiffness
/// of undeformed fibers is that in tension.
///
/// To be mixed with a ground matrix, see SolidMixture. @a Own has the threshold
/// I_0 as real_t Threshold() const and Psi' as
///
///     template <typename T> T EnergyDerivative(const T &I_n) const;
template <typename Own>
class FiberSolid : public DifferentiatedSolid<Own>
{
public:
   /// Borrows @a frame.
   explicit FiberSolid(const MaterialFrame &frame_) : frame(frame_) {}

   template <typename T>
   bool Stress(const MaterialPoint &point, const Tensor3<T> &F,
               Tensor3<T> &P) const
   {
      const Own &law = static_cast<const Own &>(*this);
      const Vector3<> n = FiberDirection(point, frame);
      const Vector3<T> stretched = Product(F, n);
      T square = InnerProduct(stretched, stretched);
      P = Tensor3<T>{};
      if (IsTaut(square))
      {
         const T tension = 2.0 * law.EnergyDerivative(square);
         AddOuterProduct(tension, stretched, n, P);
      }
      return true;
   }

   std::string Validate(mfem::ElementTransformation &trans) const override
   {
      return frame.Validate(trans);
   }
   /// Fibers alone resist no compression.
   mfem::real_t AggregateModulus() const override { return 0.0; }
   mfem::real_t ShearModulus() const override { return 0.0; }

protected:
   /// Moves I_n = @a square to the taut side where only round-off has it on the
   /// other: powers of a negative or no excess have no derivative.
   template <typename T>
   bool IsTaut(T &square) const
   {
      constexpr mfem::real_t round_off = 1e-12;
      const mfem::real_t threshold =
         static_cast<const Own &>(*this).Threshold();
      const mfem::real_t taut = threshold * (1.0 + round_off);
      if (square < taut && square > threshold * (1.0 - round_off))
      {
         square = square + (taut - ValueOf(square));
      }
      return square > threshold;
   }

   const MaterialFrame &frame;
};

} // namespace synovia
