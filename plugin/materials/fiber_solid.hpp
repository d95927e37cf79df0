#pragma once

#include "synovia/materials/differentiated_solid.hpp"
#include "synovia/materials/fiber_direction.hpp"
#include "synovia/materials/fiber_energy.hpp"

namespace synovia
{

/// Fibers along a direction: an energy Psi(I_n) of the square of their stretch,
/// I_n = n_0 . C n_0, that resists tension only:
///
///     P = 2 Psi'(I_n) (F n_0) (x) n_0 where I_n > I_0.
///
/// Where I_n equals I_0 within round-off they count as taut, so that undeformed
/// fibers have their stiffness in tension.
///
/// To be mixed with a ground matrix, see SolidMixture. @a Own has the threshold
/// I_0 as real_t Threshold() const override and Psi' as
///
///     template <typename T> T EnergyDerivative(const T &I_n) const;
template <typename Own>
class FiberSolid : public DifferentiatedSolid<Own>, public FiberEnergy
{
public:
   explicit FiberSolid(const FiberDirection &direction_) : direction(direction_)
   {
   }

   template <typename T>
   bool Stress(const MaterialPoint &point, const Tensor3<T> &F,
               Tensor3<T> &P) const
   {
      const Own &law = static_cast<const Own &>(*this);
      const Vector3<> n = direction(point);
      const Vector3<T> stretched = Product(F, n);
      T square = InnerProduct(stretched, stretched);
      P = Tensor3<T>{};
      if (IsTaut(Threshold(), square))
      {
         const T tension = 2.0 * law.EnergyDerivative(square);
         AddOuterProduct(tension, stretched, n, P);
      }
      return true;
   }

   Derivatives Differentiate(mfem::real_t square) const override
   {
      const mfem::future::dual<mfem::real_t, mfem::real_t> I_n{square, 1.0};
      const auto first = static_cast<const Own &>(*this).EnergyDerivative(I_n);
      return {first.value, first.gradient};
   }

   std::string Validate(mfem::ElementTransformation &trans) const override
   {
      return direction.Validate(trans);
   }
   /// Fibers alone resist no compression.
   mfem::real_t AggregateModulus() const override { return 0.0; }
   mfem::real_t ShearModulus() const override { return 0.0; }

protected:
   FiberDirection direction;
};

} // namespace synovia
