#pragma once

#include "synovia/materials/differentiated_solid.hpp"
#include "synovia/materials/lame_moduli.hpp"
#include "synovia/materials/law_arguments.hpp"
#include "synovia/materials/law_description.hpp"
#include "synovia/materials/tangent3.hpp"

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

   /// Several times as fast as dual numbers.
   bool GetStress(const MaterialPoint &point, const Tensor3<> &F,
                  Tensor3<> &stress, Tangent3 *tangent) const override
   {
      if (tangent)
      {
         const Tensor3<> cofactor = Cofactor(F);
         const mfem::real_t J = Determinant(F, cofactor);
         const mfem::real_t pressing = moduli.mu - moduli.lambda * std::log(J);
         *tangent = (-pressing / J) * CofactorDerivative(F);
         AddIdentity(moduli.mu, *tangent);
         AddDyad((moduli.lambda + pressing) / (J * J), cofactor, cofactor,
                 *tangent);
      }
      return DifferentiatedSolid::GetStress(point, F, stress, nullptr);
   }

   mfem::real_t AggregateModulus() const override { return moduli.Aggregate(); }
   mfem::real_t ShearModulus() const override { return moduli.mu; }

private:
   LameModuli moduli;
};

} // namespace synovia
