#pragma once

#include "synovia/fem/volume_matrices.hpp"
#include "synovia/general/load_curve.hpp"

#include <array>
#include <string>
#include <vector>

namespace synovia
{

/// A surface that a resultant moves rigidly: the components of its
/// displacement in which @a direction is not zero are direction x q, with one
/// unknown q for all of its points, and the forces that do this add up to
/// direction x curve(t) (force). The other components are free, or prescribed.
struct DrivenSurface
{
   /// In messages and output.
   std::string name;
   mfem::Array<int> boundary;
   /// A unit vector.
   std::array<mfem::real_t, 3> direction;
   LoadCurve curve;
};

/// All driven surfaces of a problem, as a map T from reduced displacements to
/// displacements, u = T w.
///
/// Reduced displacements have the size and the order of displacements; the
/// first driven dof of a surface stands for q, the others for nothing. With T,
/// equations in u become T^T K T w = T^T f, whatever the solver.
class RigidSurfaces
{
public:
   /// Borrows nothing. @a prescribed are the true dofs with a prescribed
   /// displacement. Throws Error where one of them is driven as well, or where
   /// a dof is driven twice. Collective.
   RigidSurfaces(BiphasicSpaces &spaces,
                 const std::vector<DrivenSurface> &surfaces,
                 const mfem::Array<int> &prescribed);

   bool Any() const { return distribution != nullptr; }

   /// True dofs of the reduced displacements that stand for nothing, and unit
   /// rows in Reduce()'s matrices, ascending.
   const mfem::Array<int> &Idle() const { return idle; }

   /// The matrices for reduced displacements; pressure blocks are shared.
   VolumeMatrices Reduce(const VolumeMatrices &matrices) const;
   /// A matrix for displacements, rows x dofs, becomes one for reduced ones.
   std::unique_ptr<mfem::HypreParMatrix>
   Reduce(const mfem::HypreParMatrix &matrix) const;
   /// A matrix from displacements to forces on them becomes one for reduced
   /// ones, with zeros where these stand for nothing.
   std::unique_ptr<mfem::HypreParMatrix>
   ReduceBoth(const mfem::HypreParMatrix &matrix) const;

   /// w becomes T w; f becomes T^T f.
   void Distribute(mfem::Vector &w) const;
   void Collect(mfem::Vector &f) const;

   /// Adds the resultants at time @a t to the reduced @a force.
   void AddForces(mfem::real_t t, mfem::Vector &force) const;

   struct Travel
   {
      std::string name;
      /// q (length)
      mfem::real_t distance = 0.0;
   };
   /// Travel of each surface at displacement @a u. Collective.
   std::vector<Travel> GetTravel(const mfem::Vector &u) const;

private:
   /// One surface, on this rank.
   struct Drive
   {
      std::string name;
      LoadCurve curve;
      /// The dof that stands for q, local, or -1 on the other ranks.
      int leader = -1;
      /// Component of the direction there.
      mfem::real_t share = 0.0;
   };

   MPI_Comm comm;
   std::vector<Drive> drives;
   mfem::Array<int> idle;
   std::unique_ptr<mfem::HypreParMatrix> distribution;
   std::unique_ptr<mfem::HypreParMatrix> idle_identity;
};

} // namespace synovia
