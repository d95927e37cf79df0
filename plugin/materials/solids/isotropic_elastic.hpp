#pragma once

#include "synovia/materials/lame_moduli.hpp"
#include "synovia/materials/law_arguments.hpp"
#include "synovia/materials/law_description.hpp"
#include "synovia/materials/linear_solid.hpp"

namespace synovia
{

/// Isotropic linear elasticity, uniform in space.
class IsotropicElastic : public LinearSolid
{
public:
   static LawDescription Describe()
   {
      return {"isotropic",
              "linear elastic",
              Deformation::infinitesimal,
              {YoungsModulus(), PoissonsRatio()}};
   }

   explicit IsotropicElastic(const LawArguments &from)
      : IsotropicElastic(from["E"], from["nu"])
   {
   }
   /// Young's modulus (stress) and Poisson's ratio of the drained solid. Throws
   /// Error if they are out of range.
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
