#pragma once

#include "synovia/cases/key_table.hpp"

namespace synovia
{

/// The keys of the laws that are registered.
KeyTable SolidKeys(SolidCase &solid);
KeyTable PermeabilityKeys(PermeabilityCase &permeability);

} // namespace synovia
