#pragma once

#include "synovia/materials/isotropic_permeability.hpp"
#include "synovia/materials/law_arguments.hpp"
#include "synovia/materials/law_description.hpp"
#include "synovia/materials/pore_growth.hpp"

namespace synovia
{

/// k = value f(J) I with f as in PoreGrowth (Holmes & Mow, J Biomech
/// 23(11):1145-1156, 1990).
class HolmesMowPermeability
   : public IsotropicPermeability<HolmesMowPermeability>
{
public:
   static LawDescription Describe()
   {
      return {"holmes_mow",
              "falls as the pores of cartilage close (Holmes & Mow 1990)",
              Deformation::finite,
              {ReferencePermeability(), PoreGrowth::Coefficient("M"),
               PoreGrowth::Exponent("alpha")}};
   }

   explicit HolmesMowPermeability(const LawArguments &from)
      : HolmesMowPermeability(from["value"], from["M"], from["alpha"],
                              from.solid_fraction)
   {
   }
   /// @a value is that of the undeformed body, @a solid_fraction the
   /// referential one, which ought to be the material's. Throws Error if they
   /// are out of range.
   HolmesMowPermeability(mfem::real_t value_, mfem::real_t m,
                         mfem::real_t alpha, mfem::real_t solid_fraction)
      : value(value_), growth{m, alpha, solid_fraction}
   {
      Describe().Verify({value, m, alpha});
      VerifySolidFraction(solid_fraction);
   }

   template <typename T>
   bool Spatial(const MaterialPoint &, const T &J, T &k) const
   {
      if (!(J > growth.solid_fraction))
      {
         return false;
      }
      k = value * growth(J);
      return true;
   }

   mfem::real_t ReferenceValue() const override { return value; }

private:
   mfem::real_t value;
   PoreGrowth growth;
};

} // namespace synovia
