#pragma once

#include "mfem.hpp"

#include <memory>
#include <vector>

namespace synovia
{

/// Where a matrix between two finite element spaces of a mesh has entries: in
/// rows and columns of dofs that share an element. Local dofs.
class Sparsity
{
public:
   /// Components of a node must follow each other in both spaces.
   Sparsity(const mfem::FiniteElementSpace &row_space,
            const mfem::FiniteElementSpace &column_space);

   /// Where each row begins in Columns(), and one more.
   int *Begins() { return begins.data(); }
   int *Columns() { return columns.data(); }
   std::size_t Entries() const { return columns.size(); }

private:
   std::vector<int> begins;
   std::vector<int> columns;
};

/// A matrix between two spaces that is summed from elements again and again.
class LocalMatrix
{
public:
   /// Borrows both spaces.
   LocalMatrix(mfem::ParFiniteElementSpace &row_space,
               mfem::ParFiniteElementSpace &column_space);

   void SetZero() { matrix = 0.0; }
   /// Adds an element's matrix, by local vector dofs.
   void Add(const mfem::Array<int> &rows, const mfem::Array<int> &columns,
            const mfem::DenseMatrix &entries)
   {
      matrix.AddSubMatrix(rows, columns, entries, 0);
   }
   /// On true dofs, summed over ranks. Collective.
   std::unique_ptr<mfem::HypreParMatrix> Sum();

private:
   mfem::ParFiniteElementSpace &row_space;
   mfem::ParFiniteElementSpace &column_space;
   Sparsity sparsity;
   std::vector<mfem::real_t> entries;
   mfem::SparseMatrix matrix;
};

/// P_r^T A P_c of a matrix on local dofs. hypre's product of two matrices,
/// twice, takes a fifth of the time of its product of three, which MFEM's
/// ParallelAssemble() uses. Collective.
std::unique_ptr<mfem::HypreParMatrix>
SumShared(mfem::ParFiniteElementSpace &row_space,
          mfem::ParFiniteElementSpace &column_space, mfem::SparseMatrix &local);

} // namespace synovia
