#pragma once

#include "synovia/materials/lame_moduli.hpp"
#include "synovia/materials/solid_law.hpp"

namespace synovia
{

/// Isotropic linear elasticity, uniform in space.
class IsotropicElastic : public SolidLaw
{
public:
   /// Young's modulus @a young > 0 (stress) and Poisson's ratio
   /// -1 < @a poisson < 0.5 of the drained solid. Throws Error otherwise.
   IsotropicElastic(mfem::real_t young, mfem::real_t poisson)
      : moduli(young, poisson)
   {
   }

   void GetStiffness(mfem::ElementTransformation &trans,
                     const mfem::IntegrationPoint &ip,
                     mfem::DenseMatrix &stiffness) const override;
   mfem::real_t AggregateModulus() const override { return moduli.Aggregate(); }
   mfem::real_t ShearModulus() const override { return moduli.mu; }

private:
   LameModuli moduli;
};

} // namespace synovia
