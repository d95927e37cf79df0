#pragma once

#include "mfem.hpp"

#include <memory>
#include <vector>

namespace synovia
{

/// This rank's entries of a sparse distributed vector.
struct SparsePart
{
   std::vector<int> dofs;
   std::vector<mfem::real_t> entries;

   void Add(int dof, mfem::real_t entry);
   /// Dot product on this rank.
   mfem::real_t Times(const mfem::Vector &x) const;
   mfem::Vector Dense(int size) const;
};

/// Turns an approximate inverse of A into one of A + L K R^T, L and R having
/// few sparse columns and K being diagonal, by Woodbury's formula
///
///     (A + L K R^T)^-1 = A^-1 - Z (K^-1 + R^T Z)^-1 R^T A^-1,  Z = A^-1 L.
class LowRankUpdate
{
public:
   /// Columns of L, R and Z that belong together, as this rank has them.
   struct Column
   {
      SparsePart left;
      SparsePart right;
      mfem::Vector z;
   };

   /// Sets z of columns, all at once, with @a inverse for A^-1. Collective.
   static void SolveFor(const std::vector<Column *> &columns,
                        const mfem::Solver &inverse);

   explicit LowRankUpdate(MPI_Comm comm_) : comm(comm_) {}

   /// Sets the columns, borrowed, and the diagonal of K, without zeros; none
   /// for A itself. Collective.
   void Set(std::vector<const Column *> columns, const mfem::Vector &k);

   /// @a y = A^-1 x becomes (A + L K R^T)^-1 x. Collective.
   void Correct(mfem::Vector &y) const;

private:
   MPI_Comm comm;
   std::vector<const Column *> columns;
   /// D (K^-1 + R^T Z) D, whose D makes its rows comparable.
   mfem::DenseMatrix middle;
   mfem::Vector scale;
   std::unique_ptr<mfem::DenseMatrixInverse> inverse;
};

} // namespace synovia
