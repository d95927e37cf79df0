#pragma once

#include "synovia/materials/differentiated_permeability.hpp"
#include "synovia/materials/law_arguments.hpp"
#include "synovia/materials/law_description.hpp"
#include "synovia/materials/pore_growth.hpp"

namespace synovia
{

/// Isotropic in the undeformed body: with b = F F^T,
///
///     k = (k_0 I + k_1/J^2 b + k_2/J^4 b^2) f(J), f as in PoreGrowth
///
/// (Ateshian & Weiss, J Biomech Eng 132(11):111004, 2010).
class ReferentialIsotropicPermeability
   : public DifferentiatedPermeability<ReferentialIsotropicPermeability>
{
public:
   static LawDescription Describe()
   {
      return {"referential_isotropic",
              "follows the stretch in each direction (Ateshian & Weiss 2010)",
              Deformation::finite,
              {PermeabilityPart("k0"), PermeabilityPart("k1"),
               PermeabilityPart("k2"), PoreGrowth::Coefficient("M"),
               PoreGrowth::Exponent("alpha")}};
   }

   explicit ReferentialIsotropicPermeability(const LawArguments &from)
      : ReferentialIsotropicPermeability(
           from["k0"], from["k1"], from["k2"],
           {from["M"], from["alpha"], from.solid_fraction})
   {
   }
   /// The sum of @a k0_, @a k1_ and @a k2_ is the permeability of the
   /// undeformed body. Throws Error if they are out of range or all zero.
   ReferentialIsotropicPermeability(mfem::real_t k0_, mfem::real_t k1_,
                                    mfem::real_t k2_, const PoreGrowth &growth_)
      : k0(k0_), k1(k1_), k2(k2_), growth(growth_)
   {
      Describe().Verify({k0, k1, k2, growth.m, growth.alpha});
      VerifySolidFraction(growth.solid_fraction);
      ReferencePermeability().Verify(ReferenceValue());
   }

   template <typename T>
   bool Referential(const MaterialPoint &, const Tensor3<T> &F,
                    Tensor3<T> &K) const
   {
      const Tensor3<T> cofactor = Cofactor(F);
      const T J = Determinant(F, cofactor);
      if (!(J > growth.solid_fraction))
      {
         return false;
      }
      const T f = growth(J);
      const T along_unit = k1 * f / J;
      K = (k0 * f / J) * TransposedProduct(cofactor, cofactor) +
          (k2 * f / (J * J * J)) * TransposedProduct(F, F);
      for (int i = 0; i < 3; i++)
      {
         K[i][i] = K[i][i] + along_unit;
      }
      return true;
   }

   mfem::real_t ReferenceValue() const override { return k0 + k1 + k2; }

private:
   mfem::real_t k0;
   mfem::real_t k1;
   mfem::real_t k2;
   PoreGrowth growth;
};

} // namespace synovia
