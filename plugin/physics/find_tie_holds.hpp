#pragma once

#include "synovia/contact/contact_pair.hpp"
#include "synovia/contact/tied_interface.hpp"
#include "synovia/fem/boundary_conditions.hpp"
#include "synovia/fem/rigid_ties.hpp"

#include <vector>

namespace synovia
{

/// What holds the nodes of a tie beside it: boundary conditions, driven
/// surfaces, what is tied to rigid bodies, the drainage of contact pairs, and
/// ties that are searched before it. Collective.
TieHolds FindTieHolds(BiphasicSpaces &spaces,
                      const BoundaryConditions &conditions,
                      const RigidTies &rigid,
                      const std::vector<ContactPair *> &pairs,
                      const std::vector<const TiedInterface *> &before);

} // namespace synovia
