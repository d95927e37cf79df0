#pragma once

#include "synovia/fem/boundary_conditions.hpp"
#include "synovia/physics/resisted_motions.hpp"

#include <vector>

namespace synovia
{

/// What rigid bodies, and the ligaments and joints between them, resist of the
/// rigid motions of deformable bodies that are tied to them.
///
/// For motions u of the tied nodes, free freedoms q without springs, and rows l
/// of ligaments and of prescribed coordinates of joints, it is the least of
/// |u - T q|^2 + sum (l.q)^2 over q. All is as meshed. A ligament resists along
/// its line; one in finite deformation resists across it too, by its tension.
class TiedResistance
{
public:
   /// Borrows nothing. Collective.
   TiedResistance(const RigidMotions &motions, BiphasicSpaces &spaces,
                  const BoundaryConditions &conditions);

   /// Adds a sum of c c^T, with the ligaments that are @a resisting; with none
   /// of them if it is empty.
   void AddTo(const std::vector<bool> &resisting, mfem::DenseMatrix &sum) const;

   /// As if all were taut.
   std::vector<bool> AllLigaments() const
   {
      return std::vector<bool>(ligaments.size(), true);
   }

private:
   /// Squares of the nodes that are tied to a body.
   struct Tied
   {
      /// Free freedoms without springs.
      std::vector<int> free;
      /// Number of the first of them among those of all bodies.
      int first;
      /// Of motions, of motions with freedoms, and of freedoms.
      mfem::DenseMatrix motions;
      mfem::DenseMatrix mixed;
      mfem::DenseMatrix freedoms;
   };

   void AddBody(const RigidMotions &motions, BiphasicSpaces &spaces,
                const RigidBody &body);
   void AddLigament(const Ligament &ligament, BiphasicSpaces &spaces,
                    const BoundaryConditions &conditions);
   void AddJoint(const Joint &joint, BiphasicSpaces &spaces,
                 const BoundaryConditions &conditions);
   static void AddLeast(mfem::DenseMatrix part, const mfem::DenseMatrix &mixed,
                        const mfem::DenseMatrix &freedoms,
                        mfem::DenseMatrix &sum);

   std::vector<Tied> bodies;
   int all_free = 0;
   /// Rows of each ligament, by the freedoms of all bodies.
   std::vector<std::vector<mfem::Vector>> ligaments;
   /// Rows of the coordinates of joints that are prescribed.
   std::vector<mfem::Vector> drives;
};

} // namespace synovia
