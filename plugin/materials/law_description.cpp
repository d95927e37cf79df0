#include "synovia/materials/law_description.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/text.hpp"

namespace synovia
{

using namespace mfem;

void LawParameter::Verify(real_t value) const
{
   if (!range.Has(value))
   {
      throw Error(noun + " is " + ToText(value) + "; it must be " +
                  range.Text());
   }
}

bool LawDescription::Allows(Deformation deformation) const
{
   return !only_for || *only_for == deformation;
}

const LawParameter *LawDescription::Find(const std::string &parameter) const
{
   for (const LawParameter &own : parameters)
   {
      if (own.name == parameter)
      {
         return &own;
      }
   }
   return nullptr;
}

void LawDescription::Verify(std::initializer_list<real_t> values) const
{
   MFEM_VERIFY(values.size() == parameters.size(),
               "\"" << name << "\" has " << parameters.size()
                    << " parameters, not " << values.size());
   const LawParameter *parameter = parameters.data();
   for (const real_t value : values)
   {
      parameter->Verify(value);
      parameter++;
   }
}

namespace
{
constexpr const char *permeability_unit = "length^4/(force time)";
} // namespace

LawParameter YoungsModulus()
{
   return {"E", "stress", "Young's modulus", NumberRange::Positive(), {}};
}

LawParameter PoissonsRatio()
{
   return {"nu", "", "Poisson's ratio", NumberRange::Inside(-1.0, 0.5), {}};
}

LawParameter ReferencePermeability()
{
   return {"value",
           permeability_unit,
           "the permeability",
           NumberRange::Positive(),
           {}};
}

LawParameter PermeabilityPart(const std::string &name)
{
   return {name,
           permeability_unit,
           "the permeability " + name,
           NumberRange::AtLeast(0.0),
           {}};
}

void VerifySolidFraction(real_t solid_fraction)
{
   if (!(solid_fraction > 0.0 && solid_fraction < 1.0))
   {
      throw Error("the solid fraction is " + ToText(solid_fraction) +
                  "; it must lie between 0 and 1");
   }
}

} // namespace synovia
