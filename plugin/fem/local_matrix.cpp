#include "synovia/fem/local_matrix.hpp"

namespace synovia
{

using namespace mfem;

Sparsity::Sparsity(const FiniteElementSpace &row_space,
                   const FiniteElementSpace &column_space)
{
   for (const FiniteElementSpace *space : {&row_space, &column_space})
   {
      MFEM_VERIFY(space->GetVDim() == 1 ||
                     space->GetOrdering() == Ordering::byVDIM,
                  "components of a node should follow each other");
   }
   Table dof_elements;
   Transpose(row_space.GetElementToDofTable(), dof_elements,
             row_space.GetNDofs());
   Table neighbors;
   mfem::Mult(dof_elements, column_space.GetElementToDofTable(), neighbors);
   neighbors.SortRows();

   const int row_dim = row_space.GetVDim();
   const int column_dim = column_space.GetVDim();
   begins.reserve(row_space.GetVSize() + 1);
   columns.reserve(static_cast<std::size_t>(row_dim) * column_dim *
                   neighbors.Size_of_connections());
   for (int dof = 0; dof < row_space.GetNDofs(); dof++)
   {
      for (int row = 0; row < row_dim; row++)
      {
         begins.push_back(static_cast<int>(columns.size()));
         for (int k = 0; k < neighbors.RowSize(dof); k++)
         {
            for (int d = 0; d < column_dim; d++)
            {
               columns.push_back(column_dim * neighbors.GetRow(dof)[k] + d);
            }
         }
      }
   }
   begins.push_back(static_cast<int>(columns.size()));
}

LocalMatrix::LocalMatrix(ParFiniteElementSpace &row_space_,
                         ParFiniteElementSpace &column_space_)
   : row_space(row_space_), column_space(column_space_),
     sparsity(row_space, column_space), entries(sparsity.Entries(), 0.0),
     matrix(sparsity.Begins(), sparsity.Columns(), entries.data(),
            row_space.GetVSize(), column_space.GetVSize(), false, false, true)
{
}

std::unique_ptr<HypreParMatrix> LocalMatrix::Sum()
{
   return SumShared(row_space, column_space, matrix);
}

std::unique_ptr<HypreParMatrix> SumShared(ParFiniteElementSpace &row_space,
                                          ParFiniteElementSpace &column_space,
                                          SparseMatrix &local)
{
   const HypreParMatrix diagonal(
      row_space.GetComm(), row_space.GlobalVSize(), column_space.GlobalVSize(),
      row_space.GetDofOffsets(), column_space.GetDofOffsets(), &local);
   const std::unique_ptr<HypreParMatrix> columns(
      ParMult(&diagonal, column_space.Dof_TrueDof_Matrix()));
   const std::unique_ptr<HypreParMatrix> transpose(
      row_space.Dof_TrueDof_Matrix()->Transpose());
   return std::unique_ptr<HypreParMatrix>(
      ParMult(transpose.get(), columns.get(), true));
}

} // namespace synovia
