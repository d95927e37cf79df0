#pragma once

#include "mfem.hpp"

#include <memory>
#include <vector>

namespace synovia
{

/// Sums matrices on local dofs over ranks, P_r^T A P_c, again and again, with
/// entries in the same places.
///
/// Where each entry goes is found once, eight bytes for each; from then on
/// values are added there, and only those of rows that belong to other ranks
/// travel. Two products of matrices, as in SumShared(), take ten times as long.
class SharedSum
{
public:
   /// For matrices that have entries where @a local has, in its order. Borrows
   /// both spaces, which must be conforming; sums use their offsets, too.
   /// Collective.
   SharedSum(mfem::ParFiniteElementSpace &row_space,
             mfem::ParFiniteElementSpace &column_space,
             mfem::SparseMatrix &local);

   /// The sum, on true dofs. Collective.
   /// @param entries  as many as the local matrix has; freed on the way if they
   ///                 are moved here
   std::unique_ptr<mfem::HypreParMatrix>
   Sum(std::vector<mfem::real_t> entries) const;

private:
   /// Where a block of the sum has entries.
   struct Block
   {
      std::vector<int> begins;
      std::vector<int> columns;
   };
   /// Entries that another rank gets, or those of it and where they go.
   struct Outgoing
   {
      int rank;
      int count;
   };
   struct Incoming
   {
      int rank;
      std::vector<int> places;
   };
   /// The values of the blocks, and what other ranks get, one after another.
   struct Sums
   {
      mfem::real_t *diagonal;
      int diagonal_end;
      mfem::real_t *beside;
      int beside_end;
      mfem::real_t *for_others;

      mfem::real_t &At(int place) const
      {
         return place < diagonal_end ? diagonal[place]
                : place < beside_end ? beside[place - diagonal_end]
                                     : for_others[place - beside_end];
      }
   };
   void KeepPattern(const mfem::HypreParMatrix &pattern);
   int CountOutgoing() const;
   /// Sends what other ranks get, and adds what they send.
   void AddIncoming(const std::vector<mfem::real_t> &for_others,
                    const Sums &sums) const;
   int Entries() const
   {
      return static_cast<int>(diagonal.columns.size() + beside.columns.size());
   }

   mfem::ParFiniteElementSpace &row_space;
   mfem::ParFiniteElementSpace &column_space;
   Block diagonal;
   Block beside;
   std::vector<HYPRE_BigInt> column_numbers;
   /// Of each local entry: among those of the block on the diagonal, of the one
   /// beside it, and of those for other ranks, rank by rank.
   std::vector<int> places;
   std::vector<Outgoing> outgoing;
   std::vector<Incoming> incoming;
};

/// P_r^T A P_c of a matrix on local dofs. hypre's product of two matrices,
/// twice, takes a fifth of the time of its product of three, which MFEM's
/// ParallelAssemble() uses; on one rank a copy will do. Collective.
std::unique_ptr<mfem::HypreParMatrix>
SumShared(mfem::ParFiniteElementSpace &row_space,
          mfem::ParFiniteElementSpace &column_space, mfem::SparseMatrix &local);

} // namespace synovia
