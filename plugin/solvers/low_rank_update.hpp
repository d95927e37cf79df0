#pragma once

#include "mfem.hpp"

#include <vector>

namespace synovia
{

/// Turns an approximate inverse of A into one of A + W K W^T, W having few
/// columns and K being symmetric, by Woodbury's formula
///
///     (A + W K W^T)^-1 = A^-1 - Z K (1 + W^T Z K)^-1 W^T A^-1,  Z = A^-1 W.
class LowRankUpdate
{
public:
   /// A column of W and the one of Z that belongs to it, distributed vectors.
   struct Column
   {
      mfem::Vector w;
      mfem::Vector z;
   };

   explicit LowRankUpdate(MPI_Comm comm_) : comm(comm_) {}

   /// Takes other columns, borrowed, and K; none for A as it is. Collective.
   void Set(std::vector<const Column *> columns, const mfem::DenseMatrix &k);

   /// @a y = A^-1 x becomes (A + W K W^T)^-1 x. Collective.
   void Correct(mfem::Vector &y) const;

private:
   MPI_Comm comm;
   std::vector<const Column *> columns;
   /// K (1 + W^T Z K)^-1
   mfem::DenseMatrix middle;
};

} // namespace synovia
