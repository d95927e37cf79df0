#pragma once

#include "synovia/materials/law_arguments.hpp"
#include "synovia/materials/law_description.hpp"
#include "synovia/materials/solid_law.hpp"

namespace synovia
{

/// Constants of a Donnan equilibrium; concentrations are amounts per volume of
/// fluid.
struct DonnanConstants
{
   /// Volume fraction of the fluid, and concentration of the fixed charges, of
   /// the undeformed body.
   mfem::real_t porosity;
   mfem::real_t fixed_charge;
   /// Concentration of all ions outside.
   mfem::real_t bath;
   /// Phi
   mfem::real_t osmotic_coefficient;
   /// R T (energy / amount).
   mfem::real_t thermal_energy;
};

/// The swelling of a tissue with fixed charges, such as those of proteoglycans,
/// in equilibrium with a bath of salt: a Cauchy stress -p I with
///
///     p = R T Phi (sqrt(c^2 + c_b^2) - c_b),
///     c = phi_w c_0 / (J - 1 + phi_w)
///
/// and no value where J <= 1 - phi_w. The undeformed body isn't free of stress
/// in it: it swells until the solid that it is mixed with holds it.
class Donnan : public SolidLaw
{
public:
   static LawDescription Describe();

   explicit Donnan(const LawArguments &from);
   /// Throws Error if constants are out of range.
   explicit Donnan(const DonnanConstants &constants);

   bool GetStress(const MaterialPoint &, const Tensor3<> &F, Tensor3<> &stress,
                  Tangent3 *tangent) const override;

   /// -dp/dJ of the undeformed body.
   mfem::real_t AggregateModulus() const override;
   mfem::real_t ShearModulus() const override { return 0.0; }

private:
   /// J, or p, with its derivative by J.
   using Scalar = mfem::future::dual<mfem::real_t, mfem::real_t>;
   Scalar Pressure(mfem::real_t J) const;

   DonnanConstants constants;
};

} // namespace synovia
