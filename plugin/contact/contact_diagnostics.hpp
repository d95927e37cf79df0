#pragma once

#include "synovia/contact/contact_pair.hpp"
#include "synovia/general/point3.hpp"

namespace synovia
{

/// Of a pair with friction.
struct FrictionDiagnostics
{
   /// Resultant of the tangential tractions on the destination, part of the
   /// force on it.
   Point3 force{{0.0, 0.0, 0.0}};
   /// Its size over that of the resultant of the normal tractions: mu_eff where
   /// flat surfaces slide; 0 without contact.
   mfem::real_t coefficient = 0.0;
   /// Part of the area of vertices in contact that slides.
   mfem::real_t sliding = 0.0;
   /// Work of friction since the run began (force x length): never negative in
   /// a step.
   mfem::real_t dissipation = 0.0;
};

/// Results of a pair for the history, from the last Evaluate() and
/// UpdateActiveSet().
struct ContactDiagnostics
{
   Point3 source_force{{0.0, 0.0, 0.0}};
   Point3 destination_force{{0.0, 0.0, 0.0}};
   /// Moments of the nodal forces about the origin, with the positions that
   /// the surfaces were searched in (force x length).
   Point3 source_moment{{0.0, 0.0, 0.0}};
   Point3 destination_moment{{0.0, 0.0, 0.0}};
   /// Part of the force on the destination that its fluid pressure in the
   /// contact area makes up; 0 without contact.
   mfem::real_t fluid_load_support = 0.0;
   /// See ContactArea().
   mfem::real_t area = 0.0;
   mfem::real_t penetration = 0.0;
   mfem::real_t pressure_jump = 0.0;
   mfem::real_t peak_traction = 0.0;
   /// Of the destination's fluid, averaged over a vertex's surroundings.
   mfem::real_t peak_pressure = 0.0;
   /// Fluid volume per time from the source into the destination.
   mfem::real_t fluid_exchange = 0.0;
   FrictionDiagnostics friction;
};

/// Collective.
ContactDiagnostics Diagnose(const ContactPair &pair);

/// Contact traction at the destination's vertices, per present area (stress,
/// negative in compression).
mfem::Vector PresentTraction(const ContactPair &pair);

/// Size of the tangential traction there (stress); zero without friction.
mfem::Vector PresentFriction(const ContactPair &pair);

/// Area of the destination in contact: where the mean traction around the
/// vertices, less what it would take to close the mean gap there, is
/// compressive, interpolated linearly. So the rim of the contact moves
/// continuously through the faces as the load does. What closes a gap is taken
/// as H_A / (2 h) times the gap, of the softer body and with the size h of the
/// faces: each side gives way by half. Of faces that the source covers in part,
/// that part counts. Collective.
mfem::real_t ContactArea(const ContactPair &pair);

/// Whether the pair bore traction at the end of any step. Collective.
bool HasTouched(const ContactPair &pair);

} // namespace synovia
