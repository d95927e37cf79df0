#pragma once

#include "synovia/fem/body.hpp"
#include "synovia/general/point3.hpp"

#include <string>

namespace synovia
{

/// The direction of a body's rigid motion: "along z", or "about z through
/// (x, y, z)" if it turns.
struct RigidDirection
{
   bool turns = false;
   std::string text;
};

/// The rigid motions of a problem's bodies as displacements.
///
/// A body has six: translations along x, y and z, and rotations about these
/// axes through its center, by which its farthest node moves by 1 as well.
class RigidMotions
{
public:
   static constexpr int per_body = 6;

   /// Borrows nothing. Collective.
   RigidMotions(const std::vector<Body> &bodies, BiphasicSpaces &spaces);

   /// The same with centers and radii of the bodies' nodes on boundaries with
   /// these attributes alone, for bodies that have such nodes. Collective.
   RigidMotions(const std::vector<Body> &bodies, BiphasicSpaces &spaces,
                const mfem::Array<int> &boundary);

   int Bodies() const { return static_cast<int>(centers.size()); }
   /// Number of the body that a true dof of the displacement belongs to.
   int BodyOf(int dof) const { return body_of[dof]; }
   /// Value of the dof in a motion of that body.
   mfem::real_t At(int dof, int motion) const;
   /// Displacement of a point in one of the six motions of its body.
   Point3 At(int body, int motion, const Point3 &point) const;
   /// One of the six motions of all bodies at once.
   mfem::Vector OfAll(int motion) const;
   /// One motion of one body as true dofs, zero on all others.
   mfem::Vector Displacement(int body, int motion) const;
   /// A translation of some bodies as true dofs, zero on all others.
   mfem::Vector Translation(const std::set<int> &bodies,
                            const Point3 &along) const;

   /// The direction in which a body goes that moves by a sum of its motions,
   /// with these six factors.
   RigidDirection Direction(int body, const mfem::real_t *factors) const;

   const Point3 &Center(int body) const { return centers[body]; }
   /// Distance of the farthest node from the center (length).
   mfem::real_t Radius(int body) const { return radii[body]; }

private:
   using Marker = mfem::Array<bool>;

   /// Sets center and radius of each body that has one of the dofs.
   void Center(const Marker &counts, MPI_Comm comm);

   mfem::Vector positions;
   mfem::Array<int> body_of;
   std::vector<Point3> centers;
   std::vector<mfem::real_t> radii;
};

} // namespace synovia
