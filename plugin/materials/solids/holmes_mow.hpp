#pragma once

#include "synovia/materials/differentiated_solid.hpp"
#include "synovia/materials/lame_moduli.hpp"
#include "synovia/materials/law_arguments.hpp"
#include "synovia/materials/law_description.hpp"
#include "synovia/materials/tangent3.hpp"

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
      const Parts<T> parts = Separate(F);
      P = parts.growth * parts.direction;
      return true;
   }

   /// Several times as fast as dual numbers.
   bool GetStress(const MaterialPoint &point, const Tensor3<> &F,
                  Tensor3<> &stress, Tangent3 *tangent) const override
   {
      if (tangent)
      {
         *tangent = Tangent(F);
      }
      return DifferentiatedSolid::GetStress(point, F, stress, nullptr);
   }

   mfem::real_t AggregateModulus() const override { return moduli.Aggregate(); }
   mfem::real_t ShearModulus() const override { return moduli.mu; }

private:
   /// P = growth x direction; the derivative of growth is
   /// 2 beta / H_A x growth x direction.
   template <typename T>
   struct Parts
   {
      Tensor3<T> C;
      Tensor3<T> cofactor;
      T J;
      T along_f;
      T growth;
      Tensor3<T> direction;
   };

   template <typename T>
   Parts<T> Separate(const Tensor3<T> &F) const
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
      const T along_f = 2.0 * mu - lambda + lambda * I1;
      const T along_cofactor = -modulus / J;
      return {C,
              cofactor,
              J,
              along_f,
              growth,
              along_f * F - lambda * Product(F, C) + along_cofactor * cofactor};
   }

   Tangent3 Tangent(const Tensor3<> &F) const
   {
      const mfem::real_t lambda = moduli.lambda;
      const mfem::real_t modulus = moduli.Aggregate();
      const Parts<mfem::real_t> parts = Separate(F);
      Tangent3 tangent = (-modulus / parts.J) * CofactorDerivative(F);
      AddIdentity(parts.along_f, tangent);
      AddDyad(2.0 * beta / modulus, parts.direction, parts.direction, tangent);
      AddDyad(2.0 * lambda, F, F, tangent);
      AddDyad(modulus / (parts.J * parts.J), parts.cofactor, parts.cofactor,
              tangent);
      // d(F C)/dF
      for (int i = 0; i < 3; i++)
      {
         for (int k = 0; k < 3; k++)
         {
            const mfem::real_t b =
               F[i][0] * F[k][0] + F[i][1] * F[k][1] + F[i][2] * F[k][2];
            for (int j = 0; j < 3; j++)
            {
               tangent[3 * i + j][3 * k + j] -= lambda * b;
               for (int l = 0; l < 3; l++)
               {
                  tangent[3 * i + j][3 * k + l] -=
                     lambda *
                     (F[i][l] * F[k][j] + (i == k ? parts.C[l][j] : 0.0));
               }
            }
         }
      }
      return parts.growth * tangent;
   }

   LameModuli moduli;
   mfem::real_t beta;
};

} // namespace synovia
