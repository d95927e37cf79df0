#include "synovia/materials/material_table.hpp"
#include "synovia/materials/law_description.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

void MaterialTable::Set(const Array<int> &attributes, const Material &material)
{
   MFEM_VERIFY(material.solid || !material.permeability,
               "a permeability law needs a solid law beside it");
   VerifySolidFraction(material.solid_fraction);
   for (const int attribute : attributes)
   {
      if (static_cast<int>(by_attribute.size()) <= attribute)
      {
         by_attribute.resize(attribute + 1);
      }
      by_attribute[attribute] = material;
   }
}

bool MaterialTable::Has(int attribute) const
{
   return attribute >= 0 && attribute < static_cast<int>(by_attribute.size()) &&
          by_attribute[attribute];
}

const Material &MaterialTable::Get(int attribute) const
{
   MFEM_VERIFY(Has(attribute), "no material for attribute " << attribute);
   return *by_attribute[attribute];
}

Array<int> MaterialTable::WithFluid(const Array<int> &attributes) const
{
   Array<int> wet;
   for (const int attribute : attributes)
   {
      if (Get(attribute).HasFluid())
      {
         wet.Append(attribute);
      }
   }
   return wet;
}

bool MaterialTable::HasSupply() const
{
   return std::any_of(by_attribute.begin(), by_attribute.end(),
                      [](const std::optional<Material> &material)
                      { return material && material->HasSupply(); });
}

} // namespace synovia
