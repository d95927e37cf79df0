#pragma once

#include "synovia/fem/tie_tangent.hpp"
#include "synovia/general/parallel_triplets.hpp"

#include <array>

namespace synovia
{

/// Assembled matrices for displacements as matrices for the unknowns w of a
/// displacement u = T w, whose nodes are tied to rigid bodies: w has the order
/// of u, with the amounts of the freedoms in their slots and nothing in other
/// tied dofs. Rows and columns of slots are as long as their bodies' surfaces
/// are large: for factorizations, not for multigrid.
class TieMap
{
public:
   /// Borrows @a ties, whose motions are taken as they are now. The rows of
   /// @a like are the true dofs of the displacement. Collective, as all is.
   TieMap(const TieTangent &ties, const mfem::HypreParMatrix &like);

   /// A T
   std::unique_ptr<mfem::HypreParMatrix>
   Columns(const mfem::HypreParMatrix &a) const;
   /// T^T A
   std::unique_ptr<mfem::HypreParMatrix>
   Rows(const mfem::HypreParMatrix &a) const;
   /// T^T K T + TieTangent::Stiffness(), with unit rows for tied dofs without a
   /// slot. So that nothing is divided by zero where a freedom has no
   /// resistance, each gets @a support of its nodes' own on the diagonal.
   std::unique_ptr<mfem::HypreParMatrix>
   Stiffness(const mfem::HypreParMatrix &k, mfem::real_t support) const;

private:
   /// What @a triplets, of any ranks, have for the displacement's true dofs.
   std::unique_ptr<mfem::HypreParMatrix>
   Square(const std::vector<Triplet> &triplets) const;

   const TieTangent &ties;
   HYPRE_BigInt size;
   std::array<HYPRE_BigInt, 2> offsets;
   /// Global true dofs of all slots.
   std::vector<HYPRE_BigInt> places;
   /// T
   std::unique_ptr<mfem::HypreParMatrix> map;
};

} // namespace synovia
