#pragma once

#include "mfem.hpp"

#include <vector>

namespace synovia
{

/// An order of the true dofs of an H1 space that does not depend on how many
/// ranks share the mesh, for files.
///
/// A dof goes by the first element, in the mesh before distribution, that has
/// it, and by its place among that element's dofs.
class CanonicalOrder
{
public:
   /// Collective. @a serial_elements as NamedMesh has them.
   CanonicalOrder(const mfem::ParFiniteElementSpace &space,
                  const std::vector<int> &serial_elements);

   /// Collective. The values of all dofs in this order, on rank 0; nothing on
   /// the others.
   std::vector<double> Gather(const mfem::Vector &true_dofs) const;

   /// Collective. The inverse: @a values count on rank 0 only, where there must
   /// be Size() of them.
   void Scatter(const std::vector<double> &values,
                mfem::Vector &true_dofs) const;

   /// Number of dofs of all ranks, on rank 0.
   std::size_t Size() const { return place.size(); }

private:
   MPI_Comm comm;
   /// Rank 0: how many dofs each rank has, and where they begin.
   std::vector<int> counts;
   std::vector<int> begins;
   /// Rank 0: the place in the order of the dofs rank by rank.
   std::vector<int> place;
};

} // namespace synovia
