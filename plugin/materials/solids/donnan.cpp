#include "synovia/materials/solids/donnan.hpp"
#include "synovia/materials/tangent3.hpp"

namespace synovia
{

using namespace mfem;

LawDescription Donnan::Describe()
{
   const NumberRange positive = NumberRange::Positive();
   const NumberRange not_negative = NumberRange::AtLeast(0.0);
   const std::string concentration = "amount/length^3";
   return {"donnan",
           "osmotic pressure of fixed charges in a bath of salt",
           Deformation::finite,
           {{"phiw0",
             "",
             "the volume fraction phiw0 of the fluid",
             NumberRange::Inside(0.0, 1.0),
             {}},
            {"cF0",
             concentration,
             "the concentration cF0 of the fixed charges",
             positive,
             {}},
            {"bosm",
             concentration,
             "the osmolarity bosm of the bath",
             not_negative,
             {}},
            {"Phi", "", "the osmotic coefficient Phi", not_negative, 1.0},
            {"R",
             "energy/(amount temperature)",
             "the gas constant R in the units of the case",
             positive,
             {}},
            {"T", "temperature", "the absolute temperature T", positive, {}}}};
}

Donnan::Donnan(const LawArguments &from)
   : Donnan({from["phiw0"], from["cF0"], from["bosm"], from["Phi"],
             from["R"] * from["T"]})
{
}

Donnan::Donnan(const DonnanConstants &constants_) : constants(constants_)
{
   Describe().Verify({constants.porosity, constants.fixed_charge,
                      constants.bath, constants.osmotic_coefficient,
                      constants.thermal_energy, 1.0});
}

Donnan::Scalar Donnan::Pressure(real_t J) const
{
   const Scalar porosity{J - 1.0 + constants.porosity, 1.0};
   const Scalar charge = constants.porosity * constants.fixed_charge / porosity;
   const Scalar ions = sqrt(charge * charge + constants.bath * constants.bath);
   return constants.thermal_energy * constants.osmotic_coefficient *
          (ions - constants.bath);
}

bool Donnan::GetStress(const MaterialPoint &, const Tensor3<> &F,
                       Tensor3<> &stress, Tangent3 *tangent) const
{
   const Tensor3<> cofactor = Cofactor(F);
   const real_t J = Determinant(F, cofactor);
   if (!(J > 1.0 - constants.porosity))
   {
      return false;
   }
   const Scalar pressure = Pressure(J);
   stress = -pressure.value * cofactor;
   if (tangent)
   {
      *tangent = -pressure.value * CofactorDerivative(F);
      AddDyad(-pressure.gradient, cofactor, cofactor, *tangent);
   }
   return IsFinite(stress);
}

real_t Donnan::AggregateModulus() const
{
   return -Pressure(1.0).gradient;
}

} // namespace synovia
