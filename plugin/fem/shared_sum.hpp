#pragma once

#include "mfem.hpp"

#include <memory>
#include <vector>

namespace synovia
{

/// Sums matrices on local dofs over ranks, P_r^T A P_c, again and again, with
/// entries in the same places.
///
/// Where each entry goes is found once, four bytes for each; from then on
/// values are added there, and only those of rows that belong to other ranks
/// travel. Two products of matrices, as in SumShared(), take ten times as long.
class SharedSum
{
public:
   /// For matrices that have entries where @a local has, in its order. Both
   /// spaces must be conforming. Collective.
   SharedSum(mfem::ParFiniteElementSpace &row_space,
             mfem::ParFiniteElementSpace &column_space,
             mfem::SparseMatrix &local);

   /// The sum, on true dofs. Collective.
   /// @param entries  as many as the local matrix has
   std::unique_ptr<mfem::HypreParMatrix>
   Sum(const std::vector<mfem::real_t> &entries);

private:
   struct Message
   {
      int rank;
      std::vector<mfem::real_t> values;
      /// Where what is received is added to.
      std::vector<int> places;
   };
   void ExchangeShared();

   MPI_Comm comm;
   std::unique_ptr<mfem::HypreParMatrix> pattern;
   /// Of each local entry, in sums.
   std::vector<int> places;
   /// Entries of the sum's block on the diagonal, of the one beside it, and
   /// entries for other ranks, rank by rank.
   std::vector<mfem::real_t> sums;
   std::vector<Message> outgoing;
   std::vector<Message> incoming;
};

/// P_r^T A P_c of a matrix on local dofs. hypre's product of two matrices,
/// twice, takes a fifth of the time of its product of three, which MFEM's
/// ParallelAssemble() uses; on one rank a copy will do. Collective.
std::unique_ptr<mfem::HypreParMatrix>
SumShared(mfem::ParFiniteElementSpace &row_space,
          mfem::ParFiniteElementSpace &column_space, mfem::SparseMatrix &local);

} // namespace synovia
