#pragma once

#include "synovia/materials/hyperelastic_law.hpp"
#include "synovia/materials/permeability_law.hpp"

#include <cmath>

namespace synovia
{

/// Permeability that follows finite deformation, as the referential tensor
/// K = J F^-1 k F^-T of the spatial permeability k (length^4 / (force time)):
/// the volume that flows through an undeformed area is -K grad_X p. Undeformed
/// it is isotropic.
class DeformingPermeability : public PermeabilityLaw
{
public:
   /// @a value > 0 is that of the undeformed body. Throws Error otherwise.
   explicit DeformingPermeability(mfem::real_t value);

   mfem::real_t GetPermeability(mfem::ElementTransformation &,
                                const mfem::IntegrationPoint &) const override
   {
      return value;
   }
   mfem::real_t ReferenceValue() const override { return value; }

   /// Sets K at @a point and, unless @a tangent is null, dK/dF. False where the
   /// law has no value, because the pores are closed.
   virtual bool GetReferential(const MaterialPoint &point, const Tensor3<> &F,
                               Tensor3<> &permeability,
                               Tangent3 *tangent) const = 0;

protected:
   mfem::real_t value;
};

/// A permeability law whose derivative is found by dual numbers. @a Own writes
///
///     template <typename T>
///     bool Referential(const MaterialPoint &point, const Tensor3<T> &F,
///                      Tensor3<T> &K) const;
template <typename Own>
class DifferentiatedPermeability : public DeformingPermeability
{
public:
   using DeformingPermeability::DeformingPermeability;

   bool GetReferential(const MaterialPoint &point, const Tensor3<> &F,
                       Tensor3<> &permeability,
                       Tangent3 *tangent) const override
   {
      const Own &law = static_cast<const Own &>(*this);
      if (!tangent)
      {
         return law.Referential(point, F, permeability);
      }
      Tensor3<Dual9> differentiated;
      if (!law.Referential(point, Independent(F), differentiated))
      {
         return false;
      }
      Separate(differentiated, permeability, *tangent);
      return true;
   }
};

/// Isotropic in space and constant: k = value I, whatever the deformation.
class SpatialPermeability
   : public DifferentiatedPermeability<SpatialPermeability>
{
public:
   using DifferentiatedPermeability::DifferentiatedPermeability;

   template <typename T>
   bool Referential(const MaterialPoint &, const Tensor3<T> &F,
                    Tensor3<T> &K) const
   {
      const Tensor3<T> cofactor = Cofactor(F);
      const T J = Determinant(F, cofactor);
      K = (value / J) * TransposedProduct(cofactor, cofactor);
      return true;
   }
};

/// Holmes & Mow (J Biomech 23(11):1145-1156, 1990): k = value f(J) I,
///
///     f = ((J - phi_0) / (1 - phi_0))^alpha exp(M (J^2 - 1) / 2).
class HolmesMowPermeability
   : public DifferentiatedPermeability<HolmesMowPermeability>
{
public:
   /// @a value > 0, @a m >= 0, @a alpha >= 0, and the referential solid
   /// fraction 0 < @a solid_fraction < 1, which ought to be the material's.
   /// Throws Error otherwise.
   HolmesMowPermeability(mfem::real_t value, mfem::real_t m, mfem::real_t alpha,
                         mfem::real_t solid_fraction);

   template <typename T>
   bool Referential(const MaterialPoint &, const Tensor3<T> &F,
                    Tensor3<T> &K) const
   {
      using std::exp;
      using std::pow;
      const Tensor3<T> cofactor = Cofactor(F);
      const T J = Determinant(F, cofactor);
      if (!(J > solid_fraction))
      {
         return false;
      }
      const T pores = (J - solid_fraction) / (1.0 - solid_fraction);
      const T growth =
         value * pow(pores, alpha) * exp((0.5 * m) * (J * J - 1.0));
      K = (growth / J) * TransposedProduct(cofactor, cofactor);
      return true;
   }

private:
   mfem::real_t m;
   mfem::real_t alpha;
   mfem::real_t solid_fraction;
};

} // namespace synovia
