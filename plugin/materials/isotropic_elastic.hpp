#pragma once

#include "materials/solid_law.hpp"

namespace synovia
{

/// Isotropic linear elasticity, uniform in space.
class IsotropicElastic : public SolidLaw
{
public:
   /// Young's modulus @a young > 0 (stress) and Poisson's ratio
   /// -1 < @a poisson < 0.5 of the drained solid. Throws Error otherwise.
   IsotropicElastic(mfem::real_t young, mfem::real_t poisson);

   void GetStiffness(mfem::ElementTransformation &trans,
                     const mfem::IntegrationPoint &ip,
                     mfem::DenseMatrix &stiffness) const override;
   mfem::real_t AggregateModulus() const override { return lambda + 2.0 * mu; }
   mfem::real_t ShearModulus() const override { return mu; }

private:
   mfem::real_t lambda;
   mfem::real_t mu;
};

} // namespace synovia
