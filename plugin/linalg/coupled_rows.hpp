#pragma once

#include "mfem.hpp"

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

/// This rank's rows of a distributed matrix, with global columns, without
/// zeros beside the diagonal. Collective.
mfem::SparseMatrix CoupledRows(const mfem::HypreParMatrix &matrix,
                               DroppedZeros dropped);

} // namespace synovia
