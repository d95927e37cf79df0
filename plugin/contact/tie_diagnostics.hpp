#pragma once

#include "synovia/contact/tied_interface.hpp"
#include "synovia/general/point3.hpp"

namespace synovia
{

/// Results of a tie for the history, from the last Evaluate() and
/// UpdateTractions().
struct TieDiagnostics
{
   Point3 source_force{{0.0, 0.0, 0.0}};
   Point3 destination_force{{0.0, 0.0, 0.0}};
   /// Moments of the nodal forces about the origin (force x length).
   Point3 source_moment{{0.0, 0.0, 0.0}};
   Point3 destination_moment{{0.0, 0.0, 0.0}};
   TieViolations jumps;
   /// Fluid volume per time from the source into the destination.
   mfem::real_t fluid_exchange = 0.0;
};

/// With moments where the nodes are displaced by @a u (true dofs), which is
/// zero for moments of infinitesimal deformation. Collective.
TieDiagnostics Diagnose(const TiedInterface &tie, const mfem::Vector &u);

} // namespace synovia
