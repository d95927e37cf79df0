#pragma once

#include "synovia/contact/contact_penalties.hpp"
#include "synovia/contact/contact_surface.hpp"
#include "synovia/contact/friction_state.hpp"
#include "synovia/contact/multiplier_history.hpp"
#include "synovia/general/state_archive.hpp"

#include <vector>

namespace synovia
{

/// How a vertex of the destination takes part in contact.
struct VertexContact
{
   /// It bears traction; its gap is to close.
   bool touches = false;
   /// Nothing drains there: what leaves one surface enters the other.
   bool seals = false;
   /// It sealed in this stage, and then did not.
   bool seal_broke = false;
};

/// The variables of a contact pair that a step changes, for each of this rank's
/// vertices of the destination. A failed step restores a copy of them.
struct ContactState
{
   /// Without friction unless @a rubs.
   explicit ContactState(int vertices_, bool rubs = false);

   /// Lists all of it that outlasts a step, with names that begin with
   /// @a prefix. Collective.
   void Archive(StateArchive &archive, const std::string &prefix,
                const ContactSurface &destination);

   /// 1 for the vertices that touch, 0 for others; the same for those that
   /// seal.
   mfem::Vector Touching() const;
   mfem::Vector Sealing() const;

   /// lambda (stress) and mu (length / time).
   mfem::Vector multiplier;
   mfem::Vector flux_multiplier;
   /// Length; negative where surfaces overlap.
   mfem::Vector gap;
   /// Of the pressure, source less destination (stress).
   mfem::Vector jump;
   /// Of the destination's fluid, or the source's if it alone has some
   /// (stress).
   mfem::Vector pressure;
   /// Stress, negative in compression.
   mfem::Vector traction;
   /// Out of the source (length / time).
   mfem::Vector flux;
   std::vector<VertexContact> vertices;
   /// Area x penalty of what touches or exchanges fluid, else 0.
   mfem::Vector gap_weights;
   mfem::Vector jump_weights;
   /// Whether there is friction, and what it is like.
   bool rubs = false;
   FrictionState friction;
   MultiplierHistory history;
   Stiffening stiffening;
   /// Whether a vertex of this rank bore traction at the end of any step.
   bool touched = false;
};

} // namespace synovia
