#pragma once

#include "synovia/fem/body.hpp"
#include "synovia/fem/rigid_ties.hpp"

#include <vector>

namespace synovia
{

/// The nodes of the deformable bodies that a rigid one carries: those with
/// surfaces that are tied to one rigid body and to no other.
class CarriedNodes
{
public:
   /// Borrows @a ties, of @a rigid_bodies. Collective.
   CarriedNodes(const std::vector<Body> &bodies, BiphasicSpaces &spaces,
                const std::vector<RigidBody> &rigid_bodies,
                const RigidTies &ties);

   /// Whether there are any, on whichever rank, in finite deformation.
   bool Any() const { return any; }
   /// Moves them as if rigid with what carries them, from the poses @a from to
   /// those of @a to; @a u has displacements as true dofs.
   void Carry(const RigidPoses &from, const RigidPoses &to,
              mfem::Vector &u) const;
   /// Takes their displacements from @a other.
   void Copy(const mfem::Vector &other, mfem::Vector &u) const;
   /// The largest angle (rad) by which one is turned between these poses.
   mfem::real_t Turn(const RigidPoses &from, const RigidPoses &to) const;

private:
   struct Node
   {
      /// True dof of the x component; y and z follow.
      int dof;
      /// Number of what carries it.
      int carrier;
      /// From the carrier's reference point, as meshed (length).
      Point3 arm;
   };

   const RigidTies &ties;
   std::vector<Node> nodes;
   bool any = false;
   /// Whether a rigid body carries any node of any rank.
   std::vector<bool> carries;
};

} // namespace synovia
