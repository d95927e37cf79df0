#pragma once

#include "mfem.hpp"

#include <vector>

namespace synovia
{

/// Unknowns of a distributed matrix that act on no other and that no other acts
/// on, as prescribed ones: their entries on the diagonal, not zero, are all
/// that their rows and columns have. A factorization has nothing to do with
/// them.
class LoneUnknowns
{
public:
   /// @a rows are this rank's, from the global row @a first on, with global
   /// columns. Collective.
   LoneUnknowns(const mfem::SparseMatrix &rows, int first, MPI_Comm comm);

   /// Global rows of all ranks, ascending.
   const std::vector<int> &Rows() const { return lone; }
   /// Whether a row or column, of any rank, is that of a lone unknown.
   bool Has(int row) const;
   /// The number that the row or column of another unknown has, from 0, where
   /// lone ones aren't counted.
   int NumberOfOther(int row) const;
   /// Global rows of all others among the first @a rows, ascending.
   std::vector<int> Others(int rows) const;

private:
   /// How many lone ones come before a row.
   int Before(int row) const;

   std::vector<int> lone;
   int first;
   /// Before() of this rank's rows.
   std::vector<int> before;
};

} // namespace synovia
