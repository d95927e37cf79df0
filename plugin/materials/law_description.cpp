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

void LawVector::Verify(const Point3 &value) const
{
   for (const real_t component : value)
   {
      if (!range.Has(component))
      {
         throw Error(noun + " is [" + ToText(value[0]) + ", " +
                     ToText(value[1]) + ", " + ToText(value[2]) +
                     "]; each number must be " + range.Text());
      }
   }
}

bool LawDescription::Allows(Deformation deformation) const
{
   return !only_for || *only_for == deformation;
}

namespace
{
template <typename Named>
const Named *FindNamed(const std::vector<Named> &all, const std::string &name)
{
   for (const Named &one : all)
   {
      if (one.name == name)
      {
         return &one;
      }
   }
   return nullptr;
}
} // namespace

const LawParameter *LawDescription::Find(const std::string &parameter) const
{
   return FindNamed(parameters, parameter);
}

const LawVector *LawDescription::FindVector(const std::string &vector) const
{
   return FindNamed(vectors, vector);
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
