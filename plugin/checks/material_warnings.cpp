#include "synovia/checks/material_warnings.hpp"
#include "synovia/general/text.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

namespace
{
// A bulk modulus of a hundred times the shear modulus.
constexpr real_t nearly_incompressible = 0.495;

// Above it, hexahedra and wedges of order 1 are visibly too stiff.
constexpr real_t locking = 0.45;

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

real_t LargestPoissonRatio(const SolidCase &solid)
{
   const auto poisson = solid.parameters.find("nu");
   real_t largest = poisson != solid.parameters.end() ? poisson->second : 0.0;
   for (const SolidCase &part : solid.solids)
   {
      largest = std::max(largest, LargestPoissonRatio(part));
   }
   return largest;
}

void AddLockingWarning(const MaterialCase &material, const std::string &path,
                       const CasePlaces &places,
                       std::vector<std::string> &warnings)
{
   const real_t poisson = LargestPoissonRatio(material.solid);
   if (poisson > locking && !material.mean_dilatation)
   {
      warnings.push_back(
         WhereIs(places, path + ".solid") + ": with nu = " + ToText(poisson) +
         " hexahedra and wedges of order 1 are too stiff; add "
         "mean_dilatation = true to the material, or take space.order = 2");
   }
}
} // namespace

std::vector<std::string> FindMaterialWarnings(const CaseFile &setup)
{
   std::vector<std::string> warnings;
   for (size_t i = 0; i < setup.materials.size(); i++)
   {
      const std::string path = "material." + std::to_string(i);
      AddWarnings(setup.materials[i].solid, path + ".solid", setup.places,
                  warnings);
      if (setup.space.order == 1)
      {
         AddLockingWarning(setup.materials[i], path, setup.places, warnings);
      }
   }
   return warnings;
}

} // namespace synovia
