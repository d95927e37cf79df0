#pragma once

#include "mfem.hpp"

namespace synovia
{

/// Isotropic permeability kappa (length^4 / (force time)): the relative flux is
/// -kappa grad p.
class PermeabilityLaw
{
public:
   virtual ~PermeabilityLaw() = default;

   virtual mfem::real_t
   GetPermeability(mfem::ElementTransformation &trans,
                   const mfem::IntegrationPoint &ip) const = 0;

   /// A typical value: it scales penalties and the gel time.
   virtual mfem::real_t ReferenceValue() const = 0;
};

/// The same permeability everywhere.
class ConstantPermeability : public PermeabilityLaw
{
public:
   /// Throws Error unless @a value is positive.
   explicit ConstantPermeability(mfem::real_t value);

   mfem::real_t GetPermeability(mfem::ElementTransformation &,
                                const mfem::IntegrationPoint &) const override
   {
      return value;
   }
   mfem::real_t ReferenceValue() const override { return value; }

private:
   mfem::real_t value;
};

} // namespace synovia
