#pragma once

#include "synovia/materials/differentiated_solid.hpp"
#include "synovia/materials/material_frame.hpp"

namespace synovia
{

/// The axis theta of @a frame at a point of the undeformed body.
Vector3<> FiberDirection(const MaterialPoint &point,
                         const MaterialFrame &frame);

/// Fibers along the axis theta of a frame: an energy Psi(I_n) of the square of
/// their stretch, I_n = n_0 . C n_0, that resists tension only:
///
///     P = 2 Psi'(I_n) (F n_0) (x) n_0 where I_n > I_0.
///
/// To be mixed with a ground matrix, see SolidMixture. @a Own has the threshold
/// as real_t Threshold() const and Psi' as
///
///     template <typename T> T EnergyDerivative(const T &I_n) const;
template <typename Own>
class FiberSolid : public DifferentiatedSolid<FiberSolid<Own>>
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
      Vector3<T> stretched;
      for (int i = 0; i < 3; i++)
      {
         stretched[i] = F[i][0] * n[0] + F[i][1] * n[1] + F[i][2] * n[2];
      }
      const T square = stretched[0] * stretched[0] +
                       stretched[1] * stretched[1] +
                       stretched[2] * stretched[2];
      P = Tensor3<T>{};
      if (square > law.Threshold())
      {
         const T tension = 2.0 * law.EnergyDerivative(square);
         for (int i = 0; i < 3; i++)
         {
            for (int j = 0; j < 3; j++)
            {
               P[i][j] = n[j] * (tension * stretched[i]);
            }
         }
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

private:
   const MaterialFrame &frame;
};

} // namespace synovia
