#pragma once

#include "synovia/materials/law_description.hpp"

#include <cmath>

namespace synovia
{

/// How the permeability grows with the volume ratio J of a porous body (Holmes
/// & Mow, J Biomech 23(11):1145-1156, 1990): 1 for J = 1, and
///
///     f(J) = ((J - phi_0) / (1 - phi_0))^alpha exp(M (J^2 - 1) / 2).
struct PoreGrowth
{
   mfem::real_t m;
   mfem::real_t alpha;
   /// phi_0, of the undeformed body; J must be larger.
   mfem::real_t solid_fraction;

   template <typename T>
   T operator()(const T &J) const
   {
      using std::exp;
      using std::pow;
      const T pores = (J - solid_fraction) / (1.0 - solid_fraction);
      return pow(pores, alpha) * exp((0.5 * m) * (J * J - 1.0));
   }

   /// What case files call M and alpha.
   static LawParameter Coefficient(const std::string &name)
   {
      return {
         name, "", "the coefficient " + name, NumberRange::AtLeast(0.0), {}};
   }
   static LawParameter Exponent(const std::string &name)
   {
      return {name, "", "the exponent " + name, NumberRange::AtLeast(0.0), {}};
   }
};

} // namespace synovia
