#pragma once

#include "synovia/fem/shared_sum.hpp"

#include <cstdint>
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

/// A matrix between two spaces that is summed from elements again and again:
/// Clear(), Add() and Sum(), which frees the entries until the next Clear().
///
/// Where the entries of each element go is found once: two bytes for each pair
/// of its nodes.
class LocalMatrix
{
public:
   /// Borrows both spaces.
   LocalMatrix(mfem::ParFiniteElementSpace &row_space,
               mfem::ParFiniteElementSpace &column_space);

   /// Back to the constant part; zero if there is none.
   void Clear();
   /// What was added up to now is a constant part of all sums from now on, in
   /// single precision.
   void KeepAsConstant()
   {
      constant_part.assign(entries.begin(), entries.end());
   }
   /// Adds an element's matrix; rows and columns go component by component.
   void Add(int element, const mfem::DenseMatrix &element_entries);
   /// Adds a matrix by local vector dofs that share an element.
   void Add(const mfem::Array<int> &rows, const mfem::Array<int> &columns,
            const mfem::DenseMatrix &some_entries)
   {
      matrix->AddSubMatrix(rows, columns, some_entries, 0);
   }
   /// On true dofs, summed over ranks. Collective.
   std::unique_ptr<mfem::HypreParMatrix> Sum();

private:
   void PutDiagonalFirst();
   void FindPlaces();

   mfem::ParFiniteElementSpace &row_space;
   mfem::ParFiniteElementSpace &column_space;
   /// hypre puts the diagonal's entry first in each row, and what was there
   /// where it was.
   bool diagonal_first;
   Sparsity sparsity;
   /// For each row dof its own place among its neighbors.
   std::vector<int> own_places;
   /// For each element, row dof by row dof, where its column dofs are among the
   /// neighbors; and where each element's begin.
   std::vector<std::uint16_t> places;
   std::vector<std::size_t> place_begins;
   std::vector<mfem::real_t> entries;
   /// Empty if there is none.
   std::vector<float> constant_part;
   /// Borrows the entries; null while there are none.
   std::unique_ptr<mfem::SparseMatrix> matrix;
   /// None on one rank.
   std::unique_ptr<SharedSum> shared_sum;
};

} // namespace synovia
