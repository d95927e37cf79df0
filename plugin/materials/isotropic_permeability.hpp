#pragma once

#include "synovia/materials/differentiated_permeability.hpp"
#include "synovia/materials/tangent3.hpp"

namespace synovia
{

/// A permeability that is the same in all directions of space, k = k(J) I with
/// J = det F. @a Own writes
///
///     template <typename T>
///     bool Spatial(const MaterialPoint &point, const T &J, T &k) const;
///
/// which returns false where J leaves no pores.
template <typename Own>
class IsotropicPermeability
   : public DifferentiatedPermeability<IsotropicPermeability<Own>>
{
public:
   template <typename T>
   bool Referential(const MaterialPoint &point, const Tensor3<T> &F,
                    Tensor3<T> &K) const
   {
      const Tensor3<T> cofactor = Cofactor(F);
      const T J = Determinant(F, cofactor);
      T k;
      if (!static_cast<const Own &>(*this).Spatial(point, J, k))
      {
         return false;
      }
      K = (k / J) * TransposedProduct(cofactor, cofactor);
      return true;
   }

   /// Several times as fast as dual numbers of all components.
   bool GetReferential(const MaterialPoint &point, const Tensor3<> &F,
                       Tensor3<> &permeability,
                       Tangent3 *tangent) const override
   {
      if (!tangent)
      {
         return Referential(point, F, permeability);
      }
      const Tensor3<> cofactor = Cofactor(F);
      const Volume J{Determinant(F, cofactor), 1.0};
      Volume k;
      if (!static_cast<const Own &>(*this).Spatial(point, J, k))
      {
         return false;
      }
      const Volume factor = k / J;
      const Tensor3<> square = TransposedProduct(cofactor, cofactor);
      permeability = factor.value * square;
      *tangent = Tangent3{};
      AddDyad(factor.gradient, square, cofactor, *tangent);
      AddSquareDerivative(factor.value, F, cofactor, *tangent);
      return true;
   }

   mfem::real_t GetPermeability(mfem::ElementTransformation &trans,
                                const mfem::IntegrationPoint &ip) const override
   {
      const mfem::real_t undeformed = 1.0;
      mfem::real_t k = 0.0;
      static_cast<const Own &>(*this).Spatial({trans, ip}, undeformed, k);
      return k;
   }

private:
   /// J with its own derivative.
   using Volume = mfem::future::dual<mfem::real_t, mfem::real_t>;

   // Adds factor x d(cofactor^T cofactor)/dF.
   static void AddSquareDerivative(mfem::real_t factor, const Tensor3<> &F,
                                   const Tensor3<> &cofactor, Tangent3 &tangent)
   {
      const Tangent3 derivative = CofactorDerivative(F);
      for (int i = 0; i < 3; i++)
      {
         for (int j = 0; j < 3; j++)
         {
            for (int l = 0; l < 9; l++)
            {
               const mfem::real_t half =
                  factor * (derivative[i][l] * cofactor[0][j] +
                            derivative[3 + i][l] * cofactor[1][j] +
                            derivative[6 + i][l] * cofactor[2][j]);
               tangent[3 * i + j][l] += half;
               tangent[3 * j + i][l] += half;
            }
         }
      }
   }
};

} // namespace synovia
