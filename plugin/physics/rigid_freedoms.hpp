#pragma once

#include "synovia/contact/contact_pair.hpp"
#include "synovia/fem/boundary_conditions.hpp"
#include "synovia/fem/rigid_motions.hpp"
#include "synovia/physics/tied_resistance.hpp"

namespace synovia
{

/// Which rigid motions of the bodies nothing resists.
///
/// Whatever resists one, prescribed displacements, surfaces that are moved as
/// one or are tied to rigid bodies and held by their ligaments, springs, or
/// vertices in contact, does so by a row c of what it makes of the motions r;
/// free are those with c.r = 0 for all rows, which a factorization of the sum
/// of c c^T finds. How stiff something is doesn't matter.
class RigidFreedoms
{
public:
   /// Borrows @a spaces only for the constructor. Collective.
   RigidFreedoms(const std::vector<Body> &bodies, BiphasicSpaces &spaces,
                 const BoundaryConditions &conditions);
   /// The same with these motions of the bodies.
   RigidFreedoms(const std::vector<Body> &bodies, RigidMotions motions,
                 BiphasicSpaces &spaces, const BoundaryConditions &conditions);

   const RigidMotions &Motions() const { return motions; }

   /// Motions that supports, springs and ligaments leave, which span all such:
   /// factors of the six motions of each body.
   std::vector<mfem::Vector> WithoutContact() const;

   /// Whether supports and springs alone hold all bodies.
   bool HoldAll() const { return loose.empty(); }

   /// The motions that are free with the present contact, and how to hold them;
   /// empty if there are none. Vertices count that bear a traction, in pairs
   /// that bear more than @a least_force, and ligaments that are @a resisting.
   /// Collective.
   std::string Validate(const std::vector<ContactPair *> &pairs,
                        mfem::real_t least_force,
                        const std::vector<bool> &resisting) const;
   /// The same without contact, ligaments being taut. Collective.
   std::string ValidateSupports() const
   {
      return Validate({}, 0.0, ties.AllLigaments());
   }

private:
   // Sums of c c^T: of all bodies, for contact and Supports() of those that are
   // loose.
   mfem::DenseMatrix OfSupports(BiphasicSpaces &spaces,
                                const BoundaryConditions &conditions) const;
   mfem::DenseMatrix OfDriven(BiphasicSpaces &spaces,
                              const DrivenSurface &surface) const;
   mfem::DenseMatrix OfSprings(const SpringFoundation &springs) const;
   mfem::DenseMatrix OfContact(const ContactPair &pair,
                               mfem::real_t least_force) const;
   mfem::DenseMatrix WithTies(const std::vector<bool> &resisting) const;
   mfem::DenseMatrix Supports(const std::vector<bool> &resisting) const;

   MPI_Comm comm;
   RigidMotions motions;
   TiedResistance ties;
   /// Of all but rigid bodies and contact.
   mfem::DenseMatrix others;
   /// Bodies that contact must hold, and their names.
   std::vector<int> loose;
   std::vector<std::string> names;
};

} // namespace synovia
