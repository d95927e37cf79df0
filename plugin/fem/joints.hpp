#pragma once

#include "synovia/fem/joint_coordinates.hpp"
#include "synovia/fem/rigid_ties.hpp"

#include <array>
#include <string>
#include <vector>

namespace synovia
{

/// The joints between rigid bodies: their coordinates, and what drives those
/// that are prescribed.
///
/// A coordinate c that is prescribed is a constraint c = c(t) with a multiplier
/// m, the force or moment that drives it; both have a slot of RigidTies, where
/// equations have S (c - c(t)) and unknowns m / S, S being the slot's scale.
/// Freedoms get m times the derivative of c: nothing where a body doesn't move
/// c, and no moment about the axes of the other angles.
class Joints
{
public:
   /// A joint in some pose of the bodies.
   struct State
   {
      /// rad, length.
      std::array<mfem::real_t, 6> coordinates{};
      /// What drives them, zero where they are free (force x length, force).
      std::array<mfem::real_t, 6> drives{};
   };

   /// Borrows @a ties. Joints must be without Contradiction() there. Throws
   /// Error for a prescribed coordinate that nothing changes as meshed, or that
   /// follows from others.
   Joints(const RigidTies &ties, const std::vector<Joint> &joints);

   const std::string &Name(int joint) const { return joints[joint].name; }
   bool IsPrescribed(int joint, int coordinate) const
   {
      return joints[joint].prescribed[coordinate].has_value();
   }
   std::vector<State> States(const RigidPoses &poses) const;

   /// Adds what drives exert on freedoms, and how far they are from where they
   /// should be at time @a t, to the forces in all slots.
   void AddForces(const RigidPoses &poses, mfem::real_t t,
                  mfem::Vector &forces) const;
   /// Adds the derivative of these forces with respect to the slots' amounts,
   /// less its sign: slots x slots.
   void AddStiffness(const RigidPoses &poses,
                     mfem::DenseMatrix &stiffness) const;

private:
   using Coordinates = std::array<SecondOrder<12>, 6>;

   Coordinates CoordinatesOf(int joint, const RigidPoses &poses) const;
   bool IsDriven(int joint) const;
   /// Number of a slot's freedom among the variables of a joint; -1 if it is
   /// none of them.
   int VariableOf(int joint, const RigidTies::Slot &slot) const;

   const RigidTies &ties;
   std::vector<Joint> joints;
   /// Proximal and distal body of each joint; -1: space.
   std::vector<std::array<int, 2>> bodies;
};

} // namespace synovia
