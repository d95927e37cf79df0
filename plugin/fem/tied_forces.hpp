#pragma once

#include "synovia/fem/rigid_ties.hpp"

namespace synovia
{

/// What the forces on all nodes that are tied to a body add up to.
struct TiedForces
{
   Point3 force;
   /// About the body's reference point, where that is now.
   Point3 moment;
   /// Derivative of the moment with respect to a spin that takes the nodes
   /// along, the forces being as they are; zero in infinitesimal deformation.
   mfem::DenseMatrix turning;

   /// Adds a force where the body has an @a arm from its reference point.
   void Add(const Point3 &arm, const Point3 &added, bool finite);
};

/// Of each body. @a forces are of true dofs. Collective.
std::vector<TiedForces> SumForces(const RigidTies &ties,
                                  const RigidPoses &poses,
                                  const mfem::Vector &forces);

/// What is missing for balance in each slot at time @a t: these forces, loads
/// and springs; zero in the slots of joints.
mfem::Vector FreedomForces(const RigidTies &ties, const RigidPoses &poses,
                           mfem::real_t t, const std::vector<TiedForces> &sums);

/// The derivative of FreedomForces() with respect to the slots' amounts, less
/// its sign, the forces on nodes being as they are: slots x slots.
mfem::DenseMatrix FreedomStiffness(const RigidTies &ties,
                                   const RigidPoses &poses, mfem::real_t t,
                                   const std::vector<TiedForces> &sums);

} // namespace synovia
