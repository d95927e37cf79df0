#include "synovia/materials/permeabilities/referential_orthotropic_permeability.hpp"

namespace synovia
{

using namespace mfem;

using Law = ReferentialOrthotropicPermeability;

namespace
{
const char *const axis_names[3] = {"r", "theta", "z"};

std::string Key(const std::string &name, int axis)
{
   return name + "_" + axis_names[axis];
}

Law::Along From(const LawArguments &from, int axis)
{
   return {
      from[Key("k1", axis)],
      from[Key("k2", axis)],
      {from[Key("M", axis)], from[Key("alpha", axis)], from.solid_fraction}};
}
} // namespace

LawDescription Law::Describe()
{
   LawDescription law{
      "referential_orthotropic",
      "differs along r, theta and z of the frame, and follows the stretch "
      "(Ateshian & Weiss 2010)",
      Deformation::finite,
      {PermeabilityPart("k0"), PoreGrowth::Coefficient("M0"),
       PoreGrowth::Exponent("alpha0")}};
   for (int a = 0; a < 3; a++)
   {
      law.parameters.push_back(PermeabilityPart(Key("k1", a)));
      law.parameters.push_back(PermeabilityPart(Key("k2", a)));
      law.parameters.push_back(PoreGrowth::Coefficient(Key("M", a)));
      law.parameters.push_back(PoreGrowth::Exponent(Key("alpha", a)));
   }
   return law;
}

Law::ReferentialOrthotropicPermeability(const LawArguments &from)
   : ReferentialOrthotropicPermeability(
        from["k0"], {from["M0"], from["alpha0"], from.solid_fraction},
        {{From(from, 0), From(from, 1), From(from, 2)}}, from.frame)
{
}

Law::ReferentialOrthotropicPermeability(real_t k0_, const PoreGrowth &growth_,
                                        const std::array<Along, 3> &along_,
                                        const MaterialFrame &frame_)
   : k0(k0_), growth(growth_), along(along_), frame(frame_)
{
   const auto values = [&](int a)
   {
      return std::array<real_t, 4>{
         {along[a].k1, along[a].k2, along[a].growth.m, along[a].growth.alpha}};
   };
   const auto r = values(0);
   const auto theta = values(1);
   const auto z = values(2);
   Describe().Verify({k0, growth.m, growth.alpha, r[0], r[1], r[2], r[3],
                      theta[0], theta[1], theta[2], theta[3], z[0], z[1], z[2],
                      z[3]});
   VerifySolidFraction(growth.solid_fraction);
   for (const Along &axis : along)
   {
      ReferencePermeability().Verify(k0 + axis.k1 + axis.k2);
   }
}

real_t Law::ReferenceValue() const
{
   real_t sum = 3.0 * k0;
   for (const Along &axis : along)
   {
      sum += axis.k1 + axis.k2;
   }
   return sum / 3.0;
}

} // namespace synovia
