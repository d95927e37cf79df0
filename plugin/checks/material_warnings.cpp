#include "synovia/checks/material_warnings.hpp"
#include "synovia/general/text.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
// A bulk modulus of a hundred times the shear modulus.
constexpr real_t nearly_incompressible = 0.495;
} // namespace

std::vector<std::string> FindMaterialWarnings(const CaseFile &setup)
{
   std::vector<std::string> warnings;
   for (size_t i = 0; i < setup.materials.size(); i++)
   {
      const SolidCase &solid = setup.materials[i].solid;
      if (solid.model == SolidModel::isotropic &&
          solid.poisson > nearly_incompressible)
      {
         const std::string path = "material." + std::to_string(i) + ".solid.nu";
         warnings.push_back(
            WhereIs(setup.places, path) + ": with " + ToText(solid.poisson) +
            " the drained solid itself is nearly incompressible, so that "
            "hardly any fluid leaves it; a biphasic tissue is so only as long "
            "as its fluid has no time to leave, and nu is that of the drained "
            "solid (0 to 0.3 for cartilage)");
      }
   }
   return warnings;
}

} // namespace synovia
