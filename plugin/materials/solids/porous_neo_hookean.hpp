#pragma once

#include "synovia/materials/differentiated_solid.hpp"
#include "synovia/materials/law_arguments.hpp"
#include "synovia/materials/law_description.hpp"

namespace synovia
{

/// A neo-Hookean solid whose stress grows without bound as its pores close:
///
///     Psi = mu/2 (I_1 (Jp / J)^(2/3) - 3) - mu ln Jp,
///     Jp = (J - phi_0) / (1 - phi_0), mu = E/3 (1 + (1 - phi_0)^2 / 2).
///
/// It has no value where J <= phi_0. Good in large compression.
class PorousNeoHookean : public DifferentiatedSolid<PorousNeoHookean>
{
public:
   static LawDescription Describe()
   {
      return {"porous_neo_hookean",
              "stiffens without bound as the pores close",
              Deformation::finite,
              {YoungsModulus()}};
   }

   explicit PorousNeoHookean(const LawArguments &from)
      : PorousNeoHookean(from["E"], from.solid_fraction)
   {
   }
   /// Young's modulus of small strains (stress), and the referential solid
   /// fraction, which ought to be the material's. Throws Error if they are out
   /// of range.
   PorousNeoHookean(mfem::real_t young, mfem::real_t solid_fraction_)
      : solid_fraction(solid_fraction_)
   {
      Describe().Verify({young});
      VerifySolidFraction(solid_fraction);
      const mfem::real_t pores = 1.0 - solid_fraction;
      mu = young / 3.0 * (1.0 + 0.5 * pores * pores);
      // lambda from E = mu (3 lambda + 2 mu) / (lambda + mu).
      const mfem::real_t lambda = mu * (young - 2.0 * mu) / (3.0 * mu - young);
      aggregate = lambda + 2.0 * mu;
   }

   template <typename T>
   bool Stress(const MaterialPoint &, const Tensor3<T> &F, Tensor3<T> &P) const
   {
      using std::pow;
      const mfem::real_t pores = 1.0 - solid_fraction;
      const Tensor3<T> cofactor = Cofactor(F);
      const T J = Determinant(F, cofactor);
      if (!(J > solid_fraction))
      {
         return false;
      }
      const T pore_ratio = (J - solid_fraction) / pores;
      const T I1 = Trace(TransposedProduct(F, F));
      const T ratio = pore_ratio / J;
      const T power = pow(ratio, 2.0 / 3.0);
      // d ratio / dJ = phi_0 / ((1 - phi_0) J^2)
      const T along_cofactor =
         (mu / 3.0) * I1 * power / ratio * (solid_fraction / pores) / (J * J) -
         mu / (pores * pore_ratio);
      P = (mu * power) * F + along_cofactor * cofactor;
      return true;
   }

   mfem::real_t AggregateModulus() const override { return aggregate; }
   mfem::real_t ShearModulus() const override { return mu; }

private:
   mfem::real_t solid_fraction;
   mfem::real_t mu;
   mfem::real_t aggregate;
};

} // namespace synovia
