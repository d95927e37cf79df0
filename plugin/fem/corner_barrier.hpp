#pragma once

#include "synovia/fem/body_element.hpp"
#include "synovia/materials/material_table.hpp"

#include <optional>

namespace synovia
{

/// Keeps corners of elements of order 1 from turning inside out, which they may
/// while det F is positive at all points of the quadrature. Solid tissue can't
/// be compressed, so that J = det F is above the solid fraction phi_0 wherever
/// the displacement is a possible one; where J of a corner is below it, the
/// corner stores, per volume, the energy
///
///     M (phi_0/J - 1)^3
///
/// with the aggregate modulus M of the solid, and all corners of an element
/// stand for a hundredth of its volume. Nothing is added where J is larger, so
/// that solutions which are resolved are the same without.
///
/// Tetrahedra have none, as J is the same everywhere in them, and bodies
/// without fluid don't.
class CornerBarrier
{
public:
   /// Borrows both arguments; elements must be of order 1.
   CornerBarrier(BiphasicSpaces &spaces, const MaterialTable &materials);

   /// Takes an element by its number on this rank, with the values of @a u and
   /// @a p, local dofs.
   void Set(int element, const mfem::Vector &u, const mfem::Vector &p);
   /// Adds its forces (local dofs), which aren't finite where a corner is
   /// turned inside out.
   void AddForces(mfem::Vector &forces);
   /// Adds their derivative by the displacement, dofs component by component.
   void AddTangent(mfem::DenseMatrix &stiffness);
   struct Inverted
   {
      /// Undeformed coordinates.
      mfem::Vector position;
      mfem::real_t J;
   };
   /// A corner of the element that is turned inside out, if any is.
   std::optional<Inverted> FindInverted();

private:
   /// Stress along cof F, and its derivative by J, times the corner's volume;
   /// zero where nothing is added.
   struct Resistance
   {
      mfem::real_t stress;
      mfem::real_t derivative;
   };
   Resistance ResistanceAt(int corner, mfem::real_t J) const;
   /// Whether the element has any.
   bool Applies() const { return material != nullptr; }

   BiphasicSpaces &spaces;
   const MaterialTable &materials;
   BodyElement corners;
   /// Of the element; null if it has none.
   const Material *material = nullptr;
   mfem::Vector at_nodes;
};

} // namespace synovia
