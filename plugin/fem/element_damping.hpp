#pragma once

#include "synovia/fem/body_element.hpp"
#include "synovia/materials/material_table.hpp"

#include <map>

namespace synovia
{

/// Levenberg-Marquardt damping of single elements. Where soft tissue under
/// pressure folds or bulges, its tangent is indefinite: Newton's direction
/// leads away from where the forces push, or much too far, in a few elements,
/// while all others are about to converge. The tangents of such elements get
///
///     c s int grad w : grad du
///
/// where s is the sum of the largest pressure in them and twice the solid's
/// shear modulus, of the size of what makes them unstable, and c is their
/// level: 1/4 at first, four times as much whenever that does not suffice, half
/// of it after each whole step. The balance has nothing of it, so that
/// solutions are the same without.
class ElementDamping
{
public:
   /// Borrows all arguments. @a element is set to others by all members that
   /// take a state.
   ElementDamping(BiphasicSpaces &spaces, const MaterialTable &materials,
                  BodyElement &element);

   /// Damps nothing.
   void Clear() { levels.clear(); }
   /// Damps the elements that a @a direction would strain too much, seen from
   /// the state (u, p), or damps them more; says whether there are such on any
   /// rank. Local dofs. Collective.
   bool Raise(const mfem::Vector &u, const mfem::Vector &p,
              const mfem::Vector &direction);
   /// Damps all less, and those no longer that are damped least.
   void Lower();
   /// Begins a tangent, to which nothing is added yet.
   void StartTangent() { matrices.clear(); }
   /// Adds to the @a stiffness of an element, by its number on this rank, at a
   /// state.
   void AddTangent(int number, const mfem::Vector &u, const mfem::Vector &p,
                   mfem::DenseMatrix &stiffness);
   /// Adds to @a forces what has been added to the tangent since it was begun,
   /// times a @a displacement. Local dofs.
   void AddForces(const mfem::Vector &displacement, mfem::Vector &forces) const;

private:
   /// The largest norm of the symmetric part of grad (direction) F^-1, seen
   /// from the state (u, p).
   mfem::real_t LargestStrain(int number, const mfem::Vector &u,
                              const mfem::Vector &p,
                              const mfem::Vector &direction) const;

   BiphasicSpaces &spaces;
   const MaterialTable &materials;
   BodyElement &element;
   /// Of damped elements, by number.
   std::map<int, mfem::real_t> levels;
   /// In the tangent, by number of the element.
   std::map<int, mfem::DenseMatrix> matrices;
};

} // namespace synovia
