#pragma once

#include "synovia/materials/direction_rule.hpp"
#include "synovia/materials/fiber_energy.hpp"
#include "synovia/materials/material_frame.hpp"
#include "synovia/materials/solid_law.hpp"

namespace synovia
{

/// Fibers in all directions n of the undeformed body, that resist tension only:
///
///     P = int 2 Psi'(I_n, n) (F n) (x) n dA(n) where I_n = n . C n > I_0
///
/// as a sum over directions that are fixed in the axes of a frame. The sum
/// itself has an energy, of which stress and tangent are the exact derivatives;
/// that fibers go slack all at once in a part of the sphere costs accuracy, not
/// consistency.
class FiberDistribution : public SolidLaw
{
public:
   bool GetStress(const MaterialPoint &point, const Tensor3<> &F,
                  Tensor3<> &stress, Tangent3 *tangent) const override;

   std::string Validate(mfem::ElementTransformation &trans) const override
   {
      return frame.Validate(trans);
   }
   /// Fibers alone resist no compression.
   mfem::real_t AggregateModulus() const override { return 0.0; }
   mfem::real_t ShearModulus() const override { return 0.0; }

   /// Number of directions, on half of the sphere.
   int Directions() const { return static_cast<int>(directions.size()); }

protected:
   /// Directions in the frame's axes. Borrows @a frame.
   FiberDistribution(const std::vector<WeightedDirection> &rule,
                     const MaterialFrame &frame);

   /// I_0, the same in all directions.
   virtual mfem::real_t Threshold() const = 0;
   /// Psi' and Psi'' of direction number @a direction at I_n = @a square, which
   /// is above the threshold.
   virtual FiberEnergy::Derivatives
   Differentiate(int direction, mfem::real_t square) const = 0;

private:
   static constexpr int moments = 6 + 15;

   struct Direction
   {
      mfem::real_t weight;
      /// The products of two and of four components.
      mfem::real_t products[moments];
   };

   const MaterialFrame &frame;
   std::vector<Direction> directions;
};

} // namespace synovia
