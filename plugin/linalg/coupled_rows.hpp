#pragma once

#include "synovia/linalg/lone_unknowns.hpp"

namespace synovia
{

/// Which of a matrix's zeros are no entries for a factorization. Others would
/// fill up in factors like any entry.
enum class DroppedZeros
{
   /// Those in rows and columns of unknowns that nothing else acts on, as of
   /// prescribed ones. The pattern doesn't change with what is in contact.
   of_lone_unknowns,
   /// Those of contact that is open, too.
   all
};

/// This rank's rows of a distributed matrix, with global columns, without the
/// dropped zeros beside the diagonal, and which unknowns of all ranks are lone.
struct CoupledMatrix
{
   CoupledMatrix(mfem::SparseMatrix &&rows_, int first, MPI_Comm comm)
      : lone(rows_, first, comm)
   {
      rows.Swap(rows_);
   }

   mfem::SparseMatrix rows;
   LoneUnknowns lone;
};

/// Collective.
CoupledMatrix CoupledRows(const mfem::HypreParMatrix &matrix,
                          DroppedZeros dropped);

} // namespace synovia
