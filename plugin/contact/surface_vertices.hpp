#pragma once

#include "synovia/fem/biphasic_spaces.hpp"

#include <array>
#include <memory>
#include <vector>

namespace synovia
{

/// The vertices of a surface, numbered over all ranks, so that contact data
/// have the size of the surface, whatever the mesh.
///
/// A rank owns those of its multiplier true dofs that are on the surface, in
/// ascending order. Its faces touch some of these and others' besides: local
/// vertices.
class SurfaceVertices
{
public:
   /// Collective. Borrows @a spaces; @a marker as of BoundaryMarker().
   SurfaceVertices(BiphasicSpaces &spaces, const mfem::Array<int> &marker);

   /// Of this rank's own.
   int Size() const { return true_dofs.Size(); }
   /// Ascending multiplier true dofs of these.
   const mfem::Array<int> &TrueDofs() const { return true_dofs; }
   /// Of all ranks, and the first of this one and of the next, as
   /// ParFiniteElementSpace::GetTrueDofOffsets() has them.
   HYPRE_BigInt GlobalSize() const { return global_size; }
   HYPRE_BigInt *Offsets() const { return offsets.data(); }

   int LocalSize() const { return local_dofs.Size(); }
   /// Local vertex of a local dof of the multiplier on one of this rank's
   /// faces.
   int Local(int dof) const { return local_dofs.FindSorted(dof); }
   HYPRE_BigInt Global(int local) const { return globals[local]; }

   /// Sums values at local vertices over the ranks; own vertices. Collective.
   mfem::Vector SumShared(const mfem::Vector &local) const;
   /// The other way: own vertices to the local ones of all ranks. Collective.
   mfem::Vector Share(const mfem::Vector &own) const;

   /// Own vertices to multiplier true dofs, zero off the surface; and back.
   mfem::Vector ToTrueDofs(const mfem::Vector &own) const;
   mfem::Vector FromTrueDofs(const mfem::Vector &all) const;

private:
   int space_size;
   mfem::Array<int> true_dofs;
   mfem::Array<int> local_dofs;
   HYPRE_BigInt global_size = 0;
   // hypre takes it without const.
   mutable std::array<HYPRE_BigInt, 2> offsets;
   std::array<HYPRE_BigInt, 2> local_offsets;
   std::vector<HYPRE_BigInt> globals;
   /// Local x own vertices.
   std::unique_ptr<mfem::HypreParMatrix> prolongation;
};

} // namespace synovia
