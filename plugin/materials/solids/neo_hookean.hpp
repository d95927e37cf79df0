#pragma once

#include "synovia/materials/differentiated_solid.hpp"
#include "synovia/materials/lame_moduli.hpp"
#include "synovia/materials/law_arguments.hpp"
#include "synovia/materials/law_description.hpp"

namespace synovia
{

/// Psi = mu ((I_1 - 3)/2 - ln J) + lambda/2 (ln J)^2 (Bonet & Wood, Nonlinear
/// Continuum Mechanics for Finite Element Analysis, 1997).
class NeoHookean : public DifferentiatedSolid<NeoHookean>
{
public:
   static LawDescription Describe()
   {
      return {"neo_hookean",
              "compressible neo-Hookean (Bonet & Wood 1997)",
              Deformation::finite,
              {YoungsModulus(), PoissonsRatio()}};
   }

   explicit NeoHookean(const LawArguments &from)
      : NeoHookean(from["E"], from["nu"])
   {
   }
   /// Young's modulus (stress) and Poisson's ratio of small strains. Throws
   /// Error if they are out of range.
   NeoHookean(mfem::real_t young, mfem::real_t poisson) : moduli(young, poisson)
   {
   }

   template <typename T>
   bool Stress(const MaterialPoint &, const Tensor3<T> &F, Tensor3<T> &P) const
   {
      using std::log;
      const Tensor3<T> cofactor = Cofactor(F);
      const T J = Determinant(F, cofactor);
      const T along_inverse = (moduli.lambda * log(J) - moduli.mu) / J;
      P = moduli.mu * F + along_inverse * cofactor;
      return true;
   }

   mfem::real_t AggregateModulus() const override { return moduli.Aggregate(); }
   mfem::real_t ShearModulus() const override { return moduli.mu; }

private:
   LameModuli moduli;
};

} // namespace synovia
