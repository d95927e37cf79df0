#pragma once

#include "mfem.hpp"

#include <memory>
#include <vector>

namespace synovia
{

/// Turns an approximate inverse of A into one of A + W K W^T, W having few
/// sparse columns and K being diagonal, by Woodbury's formula
///
///     (A + W K W^T)^-1 = A^-1 - Z (K^-1 + W^T Z)^-1 W^T A^-1,  Z = A^-1 W.
class LowRankUpdate
{
public:
   /// A column of W, by its non-zero entries on this rank, and this rank's part
   /// of the one of Z that belongs to it.
   struct Column
   {
      std::vector<int> dofs;
      std::vector<mfem::real_t> entries;
      mfem::Vector z;

      /// w . x on this rank.
      mfem::real_t Times(const mfem::Vector &x) const;
   };

   explicit LowRankUpdate(MPI_Comm comm_) : comm(comm_) {}

   /// Takes other columns, borrowed, and the diagonal of K, without zeros; none
   /// for A as it is. Collective.
   void Set(std::vector<const Column *> columns, const mfem::Vector &k);

   /// @a y = A^-1 x becomes (A + W K W^T)^-1 x. Collective.
   void Correct(mfem::Vector &y) const;

private:
   MPI_Comm comm;
   std::vector<const Column *> columns;
   /// D (K^-1 + W^T Z) D, whose D makes its rows comparable.
   mfem::DenseMatrix middle;
   mfem::Vector scale;
   std::unique_ptr<mfem::DenseMatrixInverse> inverse;
};

} // namespace synovia
