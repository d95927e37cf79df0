#pragma once

#include "synovia/general/error.hpp"
#include "synovia/materials/differentiated_solid.hpp"
#include "synovia/materials/law_arguments.hpp"
#include "synovia/materials/law_description.hpp"

namespace synovia
{

/// Coupled Mooney-Rivlin solid:
///
///     Psi = c_1 (I_1 - 3) + c_2 (I_2 - 3) - 2 (c_1 + 2 c_2) ln J
///           + k/2 (ln J)^2.
class MooneyRivlin : public DifferentiatedSolid<MooneyRivlin>
{
public:
   static LawDescription Describe()
   {
      const NumberRange not_negative = NumberRange::AtLeast(0.0);
      return {"mooney_rivlin",
              "coupled Mooney-Rivlin",
              Deformation::finite,
              {{"c1", "stress", "the coefficient c1 of I_1", not_negative, {}},
               {"c2", "stress", "the coefficient c2 of I_2", not_negative, {}},
               {"k", "stress", "the modulus k", NumberRange::Positive(), {}}}};
   }

   explicit MooneyRivlin(const LawArguments &from)
      : MooneyRivlin(from["c1"], from["c2"], from["k"])
   {
   }
   /// All in stress. Throws Error if they are out of range, and if c1 and c2
   /// are both zero.
   MooneyRivlin(mfem::real_t c1_, mfem::real_t c2_, mfem::real_t k_)
      : c1(c1_), c2(c2_), k(k_)
   {
      Describe().Verify({c1, c2, k});
      if (!(c1 + c2 > 0.0))
      {
         throw Error("c1 and c2 of a Mooney-Rivlin solid are both zero; it "
                     "must resist shear");
      }
   }

   template <typename T>
   bool Stress(const MaterialPoint &, const Tensor3<T> &F, Tensor3<T> &P) const
   {
      using std::log;
      const Tensor3<T> C = TransposedProduct(F, F);
      const Tensor3<T> cofactor = Cofactor(F);
      const T J = Determinant(F, cofactor);
      const T along_f = 2.0 * c1 + 2.0 * c2 * Trace(C);
      const T along_inverse = (k * log(J) - 2.0 * (c1 + 2.0 * c2)) / J;
      P = along_f * F - 2.0 * c2 * Product(F, C) + along_inverse * cofactor;
      return true;
   }

   mfem::real_t AggregateModulus() const override
   {
      return k + 4.0 * c1 + 8.0 * c2;
   }
   mfem::real_t ShearModulus() const override { return 2.0 * (c1 + c2); }

private:
   mfem::real_t c1;
   mfem::real_t c2;
   mfem::real_t k;
};

} // namespace synovia
