#pragma once

#include "synovia/fem/biphasic_spaces.hpp"
#include "synovia/materials/material_table.hpp"

namespace synovia
{

/// The true dofs of the pressure, ascending, that no element with fluid has:
/// they have no equation and must be held. Every element's attribute must have
/// a material. Collective.
mfem::Array<int> FindDryPressures(BiphasicSpaces &spaces,
                                  const MaterialTable &materials);

} // namespace synovia
