#pragma once

#include "mfem.hpp"

namespace synovia
{

/// This rank's rows of a distributed matrix, with global columns.
inline mfem::SparseMatrix LocalRows(const mfem::HypreParMatrix &matrix)
{
   mfem::SparseMatrix rows;
   // Not const, but all that it may change is on which device entries are.
   const_cast<mfem::HypreParMatrix &>(matrix).MergeDiagAndOffd(rows);
   return rows;
}

} // namespace synovia
