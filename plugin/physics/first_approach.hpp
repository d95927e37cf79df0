#pragma once

#include "synovia/fem/body.hpp"
#include "synovia/fem/boundary_conditions.hpp"
#include "synovia/physics/pushed_bodies.hpp"

namespace synovia
{

/// The start of a run with bodies that a force moves and that nothing holds
/// along it: they are moved rigidly until they touch the body that the force
/// presses them against.
///
/// A body that touches nothing would resist no force, and one that overlaps
/// another is to be pressed out of it; as a translation strains nothing, both
/// can be done before the first step, and change no stress of those that
/// follow. What a body meets goes with it unless that is held along the force.
struct FirstApproach
{
   struct Move
   {
      /// The surface that the force moves.
      std::string name;
      /// Along the force (length); negative out of an overlap.
      mfem::real_t distance = 0.0;
      /// Name of the contact pair that touches then.
      std::string pair;
   };

   /// True dofs.
   mfem::Vector displacement;
   std::vector<Move> moves;
   /// In the order of the forces, but for those whose bodies are held along
   /// them, and those that are zero for good.
   std::vector<PushedBodies> pushed;
};

/// Lets the pairs of pushed bodies look for each other where the run is to
/// start. Collective. Throws Error if a pushed body meets nothing, or if
/// surfaces overlap too deeply.
FirstApproach MakeFirstApproach(const std::vector<Body> &bodies,
                                BiphasicSpaces &spaces,
                                const BoundaryConditions &conditions,
                                const std::vector<ContactPair *> &pairs);

/// A sentence for the log.
std::string ToText(const FirstApproach::Move &move);

} // namespace synovia
