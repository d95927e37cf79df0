#pragma once

#include "synovia/cases/case_file.hpp"
#include "synovia/cases/key_table.hpp"

namespace synovia
{

// Keys of what connects rigid bodies.

KeyTable LigamentKeys(Ligament &ligament);
KeyTable JointKeys(Joint &joint);

} // namespace synovia
