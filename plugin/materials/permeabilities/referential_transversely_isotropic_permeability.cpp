#include "synovia/materials/permeabilities/referential_transversely_isotropic_permeability.hpp"

namespace synovia
{

using namespace mfem;

using AxialLaw = ReferentialTransverselyIsotropicPermeability;

LawDescription AxialLaw::Describe()
{
   return {
      "referential_transversely_isotropic",
      "differs along theta of the frame and across, and follows the stretch "
      "(Ateshian & Weiss 2010)",
      Deformation::finite,
      {PermeabilityPart("k0"), PermeabilityPart("k1T"), PermeabilityPart("k1A"),
       PermeabilityPart("k2T"), PermeabilityPart("k2A"),
       PoreGrowth::Coefficient("M0"), PoreGrowth::Coefficient("MT"),
       PoreGrowth::Coefficient("MA"), PoreGrowth::Exponent("alpha0"),
       PoreGrowth::Exponent("alphaT"), PoreGrowth::Exponent("alphaA")}};
}

AxialLaw::ReferentialTransverselyIsotropicPermeability(const LawArguments &from)
   : ReferentialTransverselyIsotropicPermeability(
        {from["k0"], from["k1T"], from["k1A"], from["k2T"], from["k2A"]},
        {from["M0"], from["alpha0"], from.solid_fraction},
        {from["MT"], from["alphaT"], from.solid_fraction},
        {from["MA"], from["alphaA"], from.solid_fraction}, from.frame)
{
}

AxialLaw::ReferentialTransverselyIsotropicPermeability(
   const AxialPermeabilities &constants_, const PoreGrowth &growth_,
   const PoreGrowth &transverse_, const PoreGrowth &axial_,
   const FiberDirection &direction_)
   : constants(constants_), growth(growth_), transverse(transverse_),
     axial(axial_), direction(direction_)
{
   Describe().Verify({constants.k0, constants.k1_transverse, constants.k1_axial,
                      constants.k2_transverse, constants.k2_axial, growth.m,
                      transverse.m, axial.m, growth.alpha, transverse.alpha,
                      axial.alpha});
   VerifySolidFraction(growth.solid_fraction);
   ReferencePermeability().Verify(Across());
   ReferencePermeability().Verify(Along());
}

real_t AxialLaw::Across() const
{
   return constants.k0 + constants.k1_transverse + constants.k2_transverse;
}

real_t AxialLaw::Along() const
{
   return constants.k0 + constants.k1_axial + constants.k2_axial;
}

real_t AxialLaw::ReferenceValue() const
{
   return (2.0 * Across() + Along()) / 3.0;
}

} // namespace synovia
