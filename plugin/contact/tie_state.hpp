#pragma once

#include "synovia/contact/contact_penalties.hpp"
#include "synovia/contact/contact_surface.hpp"
#include "synovia/contact/sliding_maps.hpp"

namespace synovia
{

/// Multipliers of a tie, or changes of them, for each of this rank's vertices
/// of the destination.
struct TieMultipliers
{
   explicit TieMultipliers(int vertices = 0);

   void Add(mfem::real_t share, const TieMultipliers &other);
   /// Lists them by names that begin with @a prefix. Collective.
   void Archive(StateArchive &archive, const std::string &prefix,
                const ContactSurface &destination);

   /// What the source exerts on the destination, by component (stress).
   VectorByComponent traction;
   /// Out of the source (length / time).
   mfem::Vector flux;
};

/// The variables of a tie that a step changes. A failed step restores a copy
/// of them.
struct TieState
{
   explicit TieState(int vertices);

   /// Keeps the multipliers as those reached at @a time.
   void Store(mfem::real_t time);
   /// Extrapolates the multipliers of two times to @a time, up to @a reach
   /// times the interval between these ahead; farther, or from one time only,
   /// it takes the last ones.
   void Predict(mfem::real_t time, mfem::real_t reach);
   /// Lists all that outlasts a step, with names that begin with @a prefix.
   /// Collective.
   void Archive(StateArchive &archive, const std::string &prefix,
                const ContactSurface &destination);

   TieMultipliers multiplier;
   /// With what the penalties add.
   TieMultipliers acting;
   /// Of the displacement (length) and of the pressure (stress), source less
   /// destination.
   VectorByComponent jump;
   mfem::Vector pressure_jump;
   /// At two times, the later one second.
   std::array<mfem::real_t, 2> times{{0.0, 0.0}};
   std::array<TieMultipliers, 2> past;
   Stiffening stiffening;
};

} // namespace synovia
