#pragma once

#include "mfem.hpp"

#include <map>

namespace synovia
{

/// Continuous fields from quantities that jump between elements, such as
/// stress, by averaging over the elements around each node.
///
/// In each element they are fitted, one order below the displacement, to values
/// at the quadrature points where they are most accurate, and evaluated at the
/// displacement's nodes; nodes take the mean of the elements around them.
/// Bodies that share no nodes are not averaged with each other; materials
/// within a body are.
class NodalRecovery
{
public:
   /// For fields of so many @a components on the H1 elements of
   /// @a displacement. Collective.
   NodalRecovery(mfem::ParFiniteElementSpace &displacement, int components);

   mfem::ParFiniteElementSpace &Space() { return space; }

   /// The points of an element at which values are wanted.
   const mfem::IntegrationRule &Points(int element)
   {
      return *ExtrapolationOf(element).rule;
   }
   /// Values at the nodes of an element, nodes x components, from those at its
   /// points, points x components.
   void ToNodes(int element, const mfem::DenseMatrix &at_points,
                mfem::DenseMatrix &at_nodes);
   /// Adds an element's values at its nodes to a field.
   void Add(int element, const mfem::DenseMatrix &at_nodes,
            mfem::ParGridFunction &field);
   /// Sums over elements, in @a field, into means over them, on all ranks.
   void Average(mfem::ParGridFunction &field) const;

private:
   /// Quadrature points and the matrix (nodes x points) that takes values at
   /// them to those at the nodes of an element.
   struct Extrapolation
   {
      const mfem::IntegrationRule *rule;
      mfem::DenseMatrix to_nodes;
   };
   const Extrapolation &ExtrapolationOf(int element);

   mfem::ParFiniteElementSpace space;
   mfem::Vector elements_of_dof;
   std::map<mfem::Geometry::Type, Extrapolation> extrapolations;
   mfem::Array<int> dofs;
};

} // namespace synovia
