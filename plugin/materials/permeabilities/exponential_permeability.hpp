#pragma once

#include "synovia/materials/isotropic_permeability.hpp"
#include "synovia/materials/law_arguments.hpp"
#include "synovia/materials/law_description.hpp"

#include <cmath>

namespace synovia
{

/// k = value exp(M (J - 1) / (J - phi_0)) I.
class ExponentialPermeability
   : public IsotropicPermeability<ExponentialPermeability>
{
public:
   static LawDescription Describe()
   {
      return {"exponential",
              "falls exponentially in compression",
              Deformation::finite,
              {ReferencePermeability(),
               {"M", "", "the coefficient M", NumberRange::AtLeast(0.0), {}}}};
   }

   explicit ExponentialPermeability(const LawArguments &from)
      : ExponentialPermeability(from["value"], from["M"], from.solid_fraction)
   {
   }
   /// @a value is that of the undeformed body, @a solid_fraction the
   /// referential one, which ought to be the material's. Throws Error if they
   /// are out of range.
   ExponentialPermeability(mfem::real_t value_, mfem::real_t m_,
                           mfem::real_t solid_fraction_)
      : value(value_), m(m_), solid_fraction(solid_fraction_)
   {
      Describe().Verify({value, m});
      VerifySolidFraction(solid_fraction);
   }

   template <typename T>
   bool Spatial(const MaterialPoint &, const T &J, T &k) const
   {
      using std::exp;
      if (!(J > solid_fraction))
      {
         return false;
      }
      k = value * exp(m * (J - 1.0) / (J - solid_fraction));
      return true;
   }

   mfem::real_t ReferenceValue() const override { return value; }

private:
   mfem::real_t value;
   mfem::real_t m;
   mfem::real_t solid_fraction;
};

} // namespace synovia
