#pragma once

#include "synovia/fem/ligament.hpp"
#include "synovia/fem/tied_forces.hpp"

#include <array>
#include <string>
#include <vector>

namespace synovia
{

/// The ligaments between rigid bodies, as forces on the bodies' freedoms.
///
/// Ends move with their bodies. In finite deformation the length is the
/// distance of the ends and the force is along the line between them; in
/// infinitesimal deformation the line is the one as meshed, and the length
/// changes by the part of the ends' displacement along it.
class Ligaments
{
public:
   /// A ligament in some pose of the bodies.
   struct State
   {
      mfem::real_t length;
      /// Tension positive.
      mfem::real_t force;
   };

   /// Borrows @a ties. Ligaments must be without Contradiction() there.
   Ligaments(const RigidTies &ties, const std::vector<Ligament> &ligaments);

   const std::string &Name(int ligament) const { return lines[ligament].name; }
   std::vector<State> States(const RigidPoses &poses) const;
   /// Whether each resists small changes of its length.
   std::vector<bool> Resisting(const RigidPoses &poses) const;

   /// Adds what they exert on each body to the forces there.
   void AddForces(const RigidPoses &poses, std::vector<TiedForces> &sums) const;
   /// Adds the derivative of their forces in the slots with respect to the
   /// slots' amounts, less its sign, as far as it is not that of constant
   /// forces on the bodies: slots x slots.
   void AddStiffness(const RigidPoses &poses,
                     mfem::DenseMatrix &stiffness) const;

private:
   struct End
   {
      /// -1: space.
      int body;
      Point3 point;
      /// From the body's reference point, as meshed.
      Point3 arm;
   };
   struct Line
   {
      std::string name;
      /// From, to.
      std::array<End, 2> ends;
      LigamentLaw law;
      /// From its first end to the second one, as meshed.
      Point3 along;
   };
   /// Where a line is now.
   struct Reach
   {
      mfem::real_t length;
      /// Unit vector from the first end to the second one.
      Point3 direction;
   };

   Reach ReachOf(const Line &line, const RigidPoses &poses) const;
   /// How the second end moves beside the first one by an amount of 1 in a
   /// slot.
   Point3 Opening(const Line &line, const RigidTies::Slot &slot,
                  const RigidPoses &poses) const;

   const RigidTies &ties;
   std::vector<Line> lines;
};

} // namespace synovia
