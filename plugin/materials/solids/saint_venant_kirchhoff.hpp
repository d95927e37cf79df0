#pragma once

#include "synovia/materials/differentiated_solid.hpp"
#include "synovia/materials/lame_moduli.hpp"
#include "synovia/materials/law_arguments.hpp"
#include "synovia/materials/law_description.hpp"

namespace synovia
{

/// Linear between the second Piola-Kirchhoff stress and Green's strain E:
/// S = lambda tr(E) I + 2 mu E. Softens in compression and fails in a large
/// one: for small strains with large rotations.
class SaintVenantKirchhoff : public DifferentiatedSolid<SaintVenantKirchhoff>
{
public:
   static LawDescription Describe()
   {
      return {"saint_venant_kirchhoff",
              "for small strains with large rotations; fails in large "
              "compression",
              Deformation::finite,
              {YoungsModulus(), PoissonsRatio()}};
   }

   explicit SaintVenantKirchhoff(const LawArguments &from)
      : SaintVenantKirchhoff(from["E"], from["nu"])
   {
   }
   /// As NeoHookean.
   SaintVenantKirchhoff(mfem::real_t young, mfem::real_t poisson)
      : moduli(young, poisson)
   {
   }

   template <typename T>
   bool Stress(const MaterialPoint &, const Tensor3<T> &F, Tensor3<T> &P) const
   {
      const Tensor3<T> C = TransposedProduct(F, F);
      const T along_f = 0.5 * moduli.lambda * (Trace(C) - 3.0) - moduli.mu;
      P = along_f * F + moduli.mu * Product(F, C);
      return true;
   }

   mfem::real_t AggregateModulus() const override { return moduli.Aggregate(); }
   mfem::real_t ShearModulus() const override { return moduli.mu; }

private:
   LameModuli moduli;
};

} // namespace synovia
