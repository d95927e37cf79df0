#pragma once

#include "synovia/materials/differentiated_solid.hpp"
#include "synovia/materials/lame_moduli.hpp"
#include "synovia/materials/law_arguments.hpp"
#include "synovia/materials/law_description.hpp"

namespace synovia
{

/// Cartilage that stiffens in compression (Holmes & Mow, J Biomech
/// 23(11):1145-1156, 1990):
///
///     Psi = H_A / (4 beta) (e^Q / J^(2 beta) - 1),
///     Q = beta / H_A ((2 mu - lambda) (I_1 - 3) + lambda (I_2 - 3)).
class HolmesMow : public DifferentiatedSolid<HolmesMow>
{
public:
   static LawDescription Describe()
   {
      return {"holmes_mow",
              "cartilage that stiffens in compression (Holmes & Mow 1990)",
              Deformation::finite,
              {YoungsModulus(),
               PoissonsRatio(),
               {"beta", "", "the exponent beta", NumberRange::Positive(), {}}}};
   }

   explicit HolmesMow(const LawArguments &from)
      : HolmesMow(from["E"], from["nu"], from["beta"])
   {
   }
   /// Young's modulus (stress) and Poisson's ratio of small strains, and
   /// @a beta. Throws Error if they are out of range.
   HolmesMow(mfem::real_t young, mfem::real_t poisson, mfem::real_t beta_)
      : moduli(young, poisson), beta(beta_)
   {
      Describe().Verify({young, poisson, beta});
   }

   template <typename T>
   bool Stress(const MaterialPoint &, const Tensor3<T> &F, Tensor3<T> &P) const
   {
      using std::exp;
      using std::log;
      const mfem::real_t mu = moduli.mu;
      const mfem::real_t lambda = moduli.lambda;
      const mfem::real_t modulus = moduli.Aggregate();
      const Tensor3<T> C = TransposedProduct(F, F);
      const Tensor3<T> cofactor = Cofactor(F);
      const T J = Determinant(F, cofactor);
      const T I1 = Trace(C);
      const T I2 = 0.5 * (I1 * I1 - Trace(Product(C, C)));
      const T exponent = (beta / modulus) * ((2.0 * mu - lambda) * (I1 - 3.0) +
                                             lambda * (I2 - 3.0)) -
                         2.0 * beta * log(J);
      const T growth = 0.5 * exp(exponent);
      const T along_f = growth * (2.0 * mu - lambda + lambda * I1);
      const T along_fc = -lambda * growth;
      const T along_cofactor = -modulus * growth / J;
      P = along_f * F + along_fc * Product(F, C) + along_cofactor * cofactor;
      return true;
   }

   mfem::real_t AggregateModulus() const override { return moduli.Aggregate(); }
   mfem::real_t ShearModulus() const override { return moduli.mu; }

private:
   LameModuli moduli;
   mfem::real_t beta;
};

} // namespace synovia
