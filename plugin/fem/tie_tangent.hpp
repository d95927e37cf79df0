#pragma once

#include "synovia/fem/joints.hpp"
#include "synovia/fem/ligaments.hpp"

namespace synovia
{

/// The linearized motion of nodes that are tied to rigid bodies, u = T q, q
/// being the amounts of the free freedoms, and what the freedoms resist beside
/// the nodes: equations in u become T^T K T + Stiffness() for q.
class TieTangent
{
public:
   /// Borrows all arguments, with all as meshed.
   TieTangent(const RigidTies &ties, const Ligaments &ligaments,
              const Joints &joints);

   const RigidTies &Ties() const { return ties; }

   /// Brings it to poses at time @a t, where the nodes have @a forces (true
   /// dofs), which count in finite deformation only. Collective.
   void Linearize(const RigidPoses &poses, mfem::real_t t,
                  const mfem::Vector &forces);

   /// Writes T q into tied dofs.
   void Move(const mfem::Vector &amounts, mfem::Vector &u) const;
   /// T^T f, on all ranks. Collective.
   mfem::Vector Collect(const mfem::Vector &f) const;
   const mfem::DenseMatrix &Stiffness() const { return stiffness; }
   /// Displacement by an amount of 1 of a freedom, of a node with this arm.
   Point3 Motion(const RigidTies::Slot &slot, const Point3 &arm) const;

private:
   const RigidTies &ties;
   const Ligaments &ligaments;
   const Joints &joints;
   std::vector<RigidFrame> frames;
   mfem::DenseMatrix stiffness;
};

} // namespace synovia
