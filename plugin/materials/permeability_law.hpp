#pragma once

#include "synovia/materials/material_point.hpp"
#include "synovia/materials/tensor3.hpp"

#include <string>

namespace synovia
{

/// Law of the permeability (length^4 / (force time)). It may vary in space.
///
/// Derive from IsotropicPermeability to write the dependence of a scalar on the
/// volume only, and from DifferentiatedPermeability to write a tensor.
class PermeabilityLaw
{
public:
   virtual ~PermeabilityLaw() = default;

   /// Sets the referential permeability K = J F^-1 k F^-T at the deformation
   /// gradient @a F, where -k grad p is the relative flux in space: -K grad_X p
   /// is the volume that flows through an undeformed area. Sets dK/dF, unless
   /// @a tangent is null. False where the law has no value, because the pores
   /// are closed.
   virtual bool GetReferential(const MaterialPoint &point, const Tensor3<> &F,
                               Tensor3<> &permeability,
                               Tangent3 *tangent) const = 0;

   /// The permeability kappa of infinitesimal deformation, which is that of the
   /// undeformed body and must be isotropic.
   virtual mfem::real_t GetPermeability(mfem::ElementTransformation &trans,
                                        const mfem::IntegrationPoint &ip) const;

   /// Why the law can't be used in an element; empty if it can.
   virtual std::string Validate(mfem::ElementTransformation &) const
   {
      return "";
   }

   /// A typical value: it scales penalties and the gel time.
   virtual mfem::real_t ReferenceValue() const = 0;
};

} // namespace synovia
