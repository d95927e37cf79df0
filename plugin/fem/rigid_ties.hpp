#pragma once

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
/// farthest tied node.
///
/// Large because equations, solvers and output each ask for another part.
class RigidTies
{
public:
   /// Borrows nothing. @a prescribed are the true dofs with a prescribed
   /// displacement. Throws Error where one of them is tied to a
   /// body that is free to move it, or is tied twice. Collective.
   RigidTies(BiphasicSpaces &spaces, const std::vector<RigidBody> &bodies,
             const mfem::Array<int> &prescribed, Deformation deformation);

   bool Any() const { return !bodies.empty(); }
   int Bodies() const { return static_cast<int>(bodies.size()); }
   const std::string &Name(int body) const { return bodies[body].name; }
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

   /// A free freedom.
   struct Slot
   {
      int body;
      int freedom;
      /// True dof, or -1 on ranks that don't have it.
      int dof;
      /// Of the freedom for an amount of 1.
      mfem::real_t scale;
   };
   const std::vector<Slot> &Slots() const { return slots; }

   /// All as meshed.
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
   void AddSlots(int body);
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
   RigidPoses origins;
};

} // namespace synovia
