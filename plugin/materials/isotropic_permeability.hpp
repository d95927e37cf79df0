#pragma once

#include "synovia/materials/differentiated_permeability.hpp"

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

   mfem::real_t GetPermeability(mfem::ElementTransformation &trans,
                                const mfem::IntegrationPoint &ip) const override
   {
      const mfem::real_t undeformed = 1.0;
      mfem::real_t k = 0.0;
      static_cast<const Own &>(*this).Spatial({trans, ip}, undeformed, k);
      return k;
   }
};

} // namespace synovia
