#pragma once

#include "synovia/materials/material_point.hpp"
#include "synovia/materials/tensor3.hpp"

#include <string>

namespace synovia
{

/// Law of the drained solid. It may vary in space.
///
/// Derive from DifferentiatedSolid to write the stress only, and from
/// LinearSolid to write a stiffness for infinitesimal deformation.
class SolidLaw
{
public:
   virtual ~SolidLaw() = default;

   /// Sets the effective first Piola-Kirchhoff stress P (force per undeformed
   /// area) at the deformation gradient @a F = I + grad u, det F > 0, and,
   /// unless @a tangent is null, dP/dF. False where the law has no value, such
   /// as for a porous solid whose pores are closed.
   virtual bool GetStress(const MaterialPoint &point, const Tensor3<> &F,
                          Tensor3<> &stress, Tangent3 *tangent) const = 0;

   /// Whether the stress turns with the body, as finite deformation requires.
   virtual bool IsObjective() const { return true; }

   /// Sets the 6 x 6 stiffness of infinitesimal deformation (stress units), in
   /// the order xx, yy, zz, xy, yz, xz with engineering shear strains: the
   /// tangent at F = I.
   virtual void GetStiffness(mfem::ElementTransformation &trans,
                             const mfem::IntegrationPoint &ip,
                             mfem::DenseMatrix &stiffness) const;

   /// Aggregate modulus H_A: the stiffness in confined compression, in the
   /// softest direction. It scales penalties, preconditioners, the gel time and
   /// the pressure stabilization.
   virtual mfem::real_t AggregateModulus() const = 0;

   /// A typical shear modulus: it scales the pressure stabilization.
   virtual mfem::real_t ShearModulus() const = 0;

   /// Why the law can't be used in an element; empty if it can.
   virtual std::string Validate(mfem::ElementTransformation &) const
   {
      return "";
   }
};

} // namespace synovia
