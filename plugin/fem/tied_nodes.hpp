#pragma once

#include "synovia/fem/biphasic_spaces.hpp"
#include "synovia/fem/rigid_body.hpp"

#include <vector>

namespace synovia
{

/// The nodes of one rank that are tied to a rigid body.
class TiedNodes
{
public:
   struct Node
   {
      /// True dof of the x component; y and z follow.
      int dof;
      /// From the reference point as meshed (length).
      Point3 arm;
   };

   /// Borrows nothing. Collective. Throws Error if the body has no nodes, or
   /// none that show how it turns.
   TiedNodes(BiphasicSpaces &spaces, const RigidBody &body);

   const std::vector<Node> &Get() const { return nodes; }
   const Point3 &Reference() const { return reference; }
   /// Distance of the farthest node of any rank from the reference point
   /// (length).
   mfem::real_t Radius() const { return radius; }

   /// Sum over all nodes of the squared displacement in a motion by 6 amounts,
   /// translations and rotations x Radius(), as a matrix of these.
   const mfem::DenseMatrix &Squares() const { return squares; }
   /// Displacement of a node, as meshed, by one of these amounts.
   Point3 Motion(int freedom, const Point3 &arm) const;

private:
   Point3 reference;
   std::vector<Node> nodes;
   mfem::real_t radius = 0.0;
   mfem::DenseMatrix squares;
};

} // namespace synovia
