#pragma once

#include "synovia/fem/joint.hpp"
#include "synovia/fem/rigid_frame.hpp"
#include "synovia/fem/tied_nodes.hpp"
#include "synovia/general/state_archive.hpp"

#include <string>
#include <vector>

namespace synovia
{

/// The displacements of all nodes that are tied to rigid bodies, as functions
/// of the bodies' poses: u = c + R X - X, X being measured from the reference
/// point; in infinitesimal deformation u = c + theta x X.
///
/// Tied dofs are no unknowns; the bodies' free freedoms are. Each of these has
/// a slot, one of its body's tied dofs, where vectors of all true dofs have its
/// amount or its force. Amounts are lengths: of rotations, those of the
/// farthest tied node. What drives a prescribed coordinate of a joint has a
/// slot too, and a place beside the poses of bodies: see Joints.
///
/// Large because equations, solvers and output each ask for another part.
class RigidTies
{
public:
   /// Borrows nothing. @a prescribed are the true dofs with a prescribed
   /// displacement. Throws Error where one of them is tied to a
   /// body that is free to move it, or is tied twice. Collective.
   RigidTies(BiphasicSpaces &spaces, const std::vector<RigidBody> &bodies,
             const mfem::Array<int> &prescribed, Deformation deformation,
             const std::vector<Joint> &joints = {});

   bool Any() const { return !bodies.empty(); }
   int Bodies() const { return static_cast<int>(bodies.size()); }
   const std::string &Name(int body) const { return bodies[body].name; }
   /// Number of the body of this name; -1 if there is none.
   int Find(const std::string &name) const;
   const RigidBodyOptions &Options(int body) const
   {
      return bodies[body].options;
   }
   const TiedNodes &Nodes(int body) const { return nodes[body]; }
   RigidFrame Frame(int body, const RigidPoses &poses) const
   {
      return {poses[body], deformation};
   }
   bool IsFinite() const { return deformation == Deformation::finite; }
   MPI_Comm GetComm() const { return comm; }

   /// Tied true dofs, ascending.
   const mfem::Array<int> &Dofs() const { return dofs; }

   /// Number of what drives a joint, among slots and poses: after all bodies.
   int DriveOf(int joint) const { return Bodies() + joint; }
   int Joints() const { return joints; }

   /// A free freedom of a body, or what drives a coordinate of a joint.
   struct Slot
   {
      /// That, or DriveOf() a joint.
      int body;
      /// That, or the coordinate.
      int freedom;
      /// True dof, or -1 on ranks that don't have it.
      int dof;
      /// Of the freedom for an amount of 1.
      mfem::real_t scale;
   };
   const std::vector<Slot> &Slots() const { return slots; }
   bool IsFreedom(const Slot &slot) const { return slot.body < Bodies(); }
   /// Sets the scales of what drives joints: a force is @a stiffness (force /
   /// length) for an amount of 1, a moment that times the radius of a body.
   void ScaleDrives(mfem::real_t stiffness);

   /// All as meshed, and nothing that drives joints.
   RigidPoses Rest() const;
   /// Lets what is prescribed relatively since time @a t count from @a poses;
   /// without, it counts from Rest().
   void SetOrigins(mfem::real_t t, const RigidPoses &poses);
   /// Lists what relative freedoms count from.
   void Archive(StateArchive &archive);
   /// Sets the prescribed freedoms to what they are at time @a t.
   void Prescribe(mfem::real_t t, RigidPoses &poses) const;
   /// Those that fit the displacements of tied dofs best, of several with the
   /// same displacements the ones nearest to @a guess. Collective.
   RigidPoses Fit(const mfem::Vector &u, const RigidPoses &guess) const;
   /// Takes rotation vectors of at most half a turn, far from where they are
   /// singular, where nothing but the rotation counts.
   void Shorten(RigidPoses &poses) const;
   /// Writes the displacements of tied dofs.
   void Write(const RigidPoses &poses, mfem::Vector &u) const;
   /// Moves free freedoms by @a share of their amounts in @a step.
   RigidPoses Moved(const RigidPoses &poses, mfem::real_t share,
                    const mfem::Vector &step) const;

   /// Amounts in the slots, on all ranks. Collective.
   mfem::Vector Gather(const mfem::Vector &w) const;
   /// Writes amounts into the slots.
   void Scatter(const mfem::Vector &amounts, mfem::Vector &w) const;

private:
   /// The next of a body's tied dofs that has no slot; -1 on ranks without it.
   int TakePlace(int body);
   void AddSlots(int body);
   /// Slots of a joint, among the tied dofs that its bodies have left.
   void AddDrives(const Joint &joint);
   /// Whether nothing but the rotation itself counts of its vector.
   bool OnlyTurns(int body) const;
   /// Least squares of one step from a pose; gives the largest amount.
   mfem::real_t Approach(int body, const mfem::Vector &u,
                         RigidPose &pose) const;

   Deformation deformation;
   MPI_Comm comm;
   std::vector<RigidBody> bodies;
   std::vector<TiedNodes> nodes;
   mfem::Array<int> dofs;
   std::vector<Slot> slots;
   /// How many slots there are at each body's tied dofs.
   std::vector<int> taken;
   int joints = 0;
   /// Radius of a body, by joint (length).
   std::vector<mfem::real_t> radii;
   RigidPoses origins;
};

} // namespace synovia
