#pragma once

#include "mfem.hpp"

#include <vector>

namespace synovia
{

/// An order of the true dofs of an H1 space that does not depend on how many
/// ranks share the mesh, for files. Each rank has a part of it, the next rank
/// the part after that; none has the whole.
///
/// A dof goes by the first element, in the mesh before distribution, that has
/// it, and by its place among that element's dofs.
class CanonicalOrder
{
public:
   /// Collective. @a serial_elements as NamedMesh has them.
   CanonicalOrder(const mfem::ParFiniteElementSpace &space,
                  const std::vector<int> &serial_elements);

   /// How many dofs come before this rank's part, and how many are in it.
   std::size_t Begin() const { return begin; }
   std::size_t Size() const { return place.size(); }

   /// Collective. The values in this rank's part of the order.
   std::vector<double> ToOrder(const mfem::Vector &true_dofs) const;

   /// Collective. The inverse of ToOrder(): @a part has Size() values.
   void FromOrder(const std::vector<double> &part,
                  mfem::Vector &true_dofs) const;

private:
   MPI_Comm comm;
   /// By rank: which of this rank's dofs are in its part.
   std::vector<std::vector<int>> sent;
   /// By rank: how many dofs of this part it has.
   std::vector<std::size_t> received;
   /// The place in the part of what is received, rank by rank.
   std::vector<std::size_t> place;
   std::size_t begin = 0;
};

} // namespace synovia
