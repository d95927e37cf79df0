#pragma once

#include "mfem.hpp"

#include <string>

namespace synovia
{

/// Linear elastic law of the drained solid: sigma_E = C eps.
///
/// Voigt order is xx, yy, zz, xy, yz, xz with engineering shear strains. The
/// law may vary in space; it does not depend on the deformation.
class SolidLaw
{
public:
   virtual ~SolidLaw() = default;

   /// Sets the 6 x 6 stiffness (stress units) at a point of an element.
   virtual void GetStiffness(mfem::ElementTransformation &trans,
                             const mfem::IntegrationPoint &ip,
                             mfem::DenseMatrix &stiffness) const = 0;

   /// Aggregate modulus H_A: the stiffness in confined compression, in the
   /// softest direction. It scales penalties, preconditioners, the gel time and
   /// the pressure stabilization.
   virtual mfem::real_t AggregateModulus() const = 0;

   /// Says what is wrong with the law in an element; empty if nothing is.
   virtual std::string Validate(mfem::ElementTransformation &) const
   {
      return "";
   }

   /// A typical shear modulus: it scales the pressure stabilization.
   virtual mfem::real_t ShearModulus() const = 0;
};

} // namespace synovia
