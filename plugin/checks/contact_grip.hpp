#pragma once

#include "synovia/cases/case_problem.hpp"
#include "synovia/fem/body.hpp"
#include "synovia/fem/rigid_motions.hpp"

#include <array>
#include <vector>

namespace synovia
{

/// How contact, which pushes along normals alone, and loads can hold bodies
/// against rigid motions; factors of the six RigidMotions of each body.
class ContactGrip
{
public:
   /// Borrows @a motions. Collective.
   ContactGrip(const CaseFile &setup, CaseProblem &problem,
               const std::vector<Body> &bodies, const RigidMotions &motions);

   /// Motions that together span as many as @a free does.
   struct Motions
   {
      /// Along which the surfaces in contact pairs only slide.
      std::vector<mfem::Vector> sliding;
      /// Those of @a free that contact resists.
      std::vector<mfem::Vector> resisted;
   };
   /// Collective.
   Motions Split(const std::vector<mfem::Vector> &free) const;

   /// Whether contact resists a motion, but not the opposite one, or the other
   /// way round. Collective.
   bool FromOneSide(const mfem::Vector &motion) const;

   bool HasContact(int body) const { return loads[body].contact; }
   /// Whether tractions or forces act on a body along a motion of it.
   bool IsLoaded(int body, const mfem::Vector &motion) const;
   /// Whether a force moves the body along it until it touches.
   bool IsDriven(int body, const mfem::Vector &motion) const;

private:
   /// A corner of a face: its share of the face's area, along the normal.
   struct Corner
   {
      int body;
      Point3 place;
      Point3 area;
   };
   struct Loads
   {
      bool contact = false;
      std::array<bool, 3> loaded{{false, false, false}};
      std::array<bool, 3> driven{{false, false, false}};
   };
   void AddCorners(const mfem::Array<int> &surfaces, BiphasicSpaces &spaces,
                   const std::vector<Body> &bodies);
   void AddLoads(const BoundaryCase &boundary, Loads &of_body) const;
   void AddLoads(const RigidBodyOptions &body, Loads &of_body) const;
   /// Along a motion: by translations alone, or by any if it turns.
   bool Any(const std::array<bool, 3> &axes, int body,
            const mfem::Vector &motion) const;
   /// Volume that the corner sweeps outward in each motion of its body.
   std::array<mfem::real_t, RigidMotions::per_body>
   Swept(const Corner &corner) const;

   const RigidMotions &motions;
   MPI_Comm comm;
   std::vector<Corner> corners;
   /// Of the surfaces in contact pairs, by body.
   std::vector<mfem::real_t> areas;
   std::vector<Loads> loads;
};

} // namespace synovia
