#pragma once

#include "synovia/materials/differentiated_solid.hpp"

namespace synovia
{

/// Coupled Mooney-Rivlin solid:
///
///     Psi = c_1 (I_1 - 3) + c_2 (I_2 - 3) - 2 (c_1 + 2 c_2) ln J
///           + k/2 (ln J)^2.
class MooneyRivlin : public DifferentiatedSolid<MooneyRivlin>
{
public:
   /// All in stress; c1 + c2 and k must be positive, no one negative. Throws
   /// Error otherwise.
   MooneyRivlin(mfem::real_t c1, mfem::real_t c2, mfem::real_t k);

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
