#pragma once

#include "synovia/cases/case_file.hpp"
#include "synovia/cases/key_table.hpp"

namespace synovia
{

// Keys of what is prescribed, and of what steps change of it.

KeyTable BoundaryKeys(BoundaryCase &boundary);
KeyTable StepBoundaryKeys(BoundaryCase &boundary);
KeyTable RigidBodyKeys(RigidBodyCase &body);
KeyTable StepRigidBodyKeys(RigidBodyCase &body);
/// Those of steps are the same.
KeyTable ContactKeys(ContactCase &contact);

KeyTable TieKeys(TieCase &tie);

} // namespace synovia
