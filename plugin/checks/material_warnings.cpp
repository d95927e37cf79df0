#include "synovia/checks/material_warnings.hpp"
#include "synovia/general/text.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
// A bulk modulus of a hundred times the shear modulus.
constexpr real_t nearly_incompressible = 0.495;

void AddWarnings(const SolidCase &solid, const std::string &path,
                 const CasePlaces &places, std::vector<std::string> &warnings)
{
   const auto poisson = solid.parameters.find("nu");
   if (poisson != solid.parameters.end() &&
       poisson->second > nearly_incompressible)
   {
      warnings.push_back(
         WhereIs(places, path + ".nu") + ": with " + ToText(poisson->second) +
         " the drained solid itself is nearly incompressible, so that "
         "hardly any fluid leaves it; a biphasic tissue is so only as long "
         "as its fluid has no time to leave, and nu is that of the drained "
         "solid (0 to 0.3 for cartilage)");
   }
   for (size_t i = 0; i < solid.solids.size(); i++)
   {
      AddWarnings(solid.solids[i], path + ".solids." + std::to_string(i),
                  places, warnings);
   }
}
} // namespace

std::vector<std::string> FindMaterialWarnings(const CaseFile &setup)
{
   std::vector<std::string> warnings;
   for (size_t i = 0; i < setup.materials.size(); i++)
   {
      AddWarnings(setup.materials[i].solid,
                  "material." + std::to_string(i) + ".solid", setup.places,
                  warnings);
   }
   return warnings;
}

} // namespace synovia
