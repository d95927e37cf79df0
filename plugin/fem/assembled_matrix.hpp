#pragma once

#include "synovia/fem/node_pattern.hpp"

#include <cstddef>
#include <memory>
#include <vector>

namespace synovia
{

/// A matrix between two spaces that is assembled from elements again and again,
/// in the arrays of the distributed matrix itself: Clear(), Add() and Sum(),
/// which gives them away. Only rows that belong to other ranks travel.
class AssembledMatrix
{
public:
   /// Borrows both spaces. Collective.
   AssembledMatrix(mfem::ParFiniteElementSpace &row_space,
                   mfem::ParFiniteElementSpace &column_space);
   /// The same with the pattern of spaces that have the same nodes, which is
   /// shared; not collective.
   AssembledMatrix(mfem::ParFiniteElementSpace &row_space,
                   mfem::ParFiniteElementSpace &column_space,
                   std::shared_ptr<const NodePattern> pattern);
   const std::shared_ptr<const NodePattern> &Pattern() const { return pattern; }

   /// Back to the constant part; zero if there is none.
   void Clear();
   /// What was added up to now is a constant part of all sums from now on, in
   /// single precision; to be cleared before more is added.
   void KeepAsConstant();
   /// Adds an element's matrix, (row components x row nodes) x (column
   /// components x column nodes), component by component; after Clear().
   void Add(int element, const mfem::DenseMatrix &entries);
   /// Adds the transpose of @a entries, columns x rows.
   void AddTransposed(int element, const mfem::DenseMatrix &entries);
   /// Adds a matrix by local vector dofs that share an element, component by
   /// component.
   void Add(const mfem::Array<int> &rows, const mfem::Array<int> &columns,
            const mfem::DenseMatrix &entries);
   /// Adds the transpose of @a entries, columns x rows.
   void AddTransposed(const mfem::Array<int> &rows,
                      const mfem::Array<int> &columns,
                      const mfem::DenseMatrix &entries);
   /// On true dofs, summed over ranks, of what was added since Clear(), which
   /// must come before anything else is added. Collective.
   std::unique_ptr<mfem::HypreParMatrix> Sum();

private:
   /// Entries of a node's row: of components a and b and the j-th column node
   /// at a x row_stride + b x column_stride + j x node_stride.
   struct RowView
   {
      const mfem::real_t *entries;
      std::ptrdiff_t row_stride;
      std::ptrdiff_t column_stride;
      std::ptrdiff_t node_stride;
   };
   /// Entries of rows of nodes, component by component, with their columns node
   /// by node.
   struct Block
   {
      const NodePattern::Lists &lists;
      /// As many as there are of pairs in the lists, times this.
      int per_pair;
      /// None until it is cleared.
      mfem::Array<mfem::real_t> entries;
      /// Empty if there is none.
      std::vector<float> constant_part;

      int Size() const
      {
         return per_pair * static_cast<int>(lists.nodes.size());
      }
      void Clear();
      mfem::real_t *Row(int row)
      {
         return entries.GetData() + per_pair * lists.Begin(row);
      }
   };

   void Add(int element, const mfem::DenseMatrix &entries, bool transposed);
   void Add(const mfem::Array<int> &rows, const mfem::Array<int> &columns,
            const mfem::DenseMatrix &entries, bool transposed);
   /// Of the first node's row, of a matrix or its transpose that goes component
   /// by component, and how far the next node's is.
   RowView View(const mfem::DenseMatrix &entries, bool transposed,
                std::ptrdiff_t &next_row) const;
   /// Adds to a row as NodePattern::Row() has it, with the places of columns.
   template <typename Place>
   void AddRow(int row, const Place *places, int width, const RowView &view);
   void AddIncoming();
   /// Columns of a block's rows, by vector dofs; and where rows begin.
   mfem::Array<int> Columns(const Block &block) const;
   mfem::Array<int> Begins(const Block &block) const;

   mfem::ParFiniteElementSpace &row_space;
   mfem::ParFiniteElementSpace &column_space;
   int row_dim;
   int column_dim;
   std::shared_ptr<const NodePattern> pattern;
   Block diagonal;
   Block beside;
   /// Of other ranks.
   Block foreign;
};

} // namespace synovia
