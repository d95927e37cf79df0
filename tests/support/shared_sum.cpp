#include "support/shared_sum.hpp"

namespace synovia
{

using namespace mfem;

std::unique_ptr<HypreParMatrix> SumShared(ParFiniteElementSpace &row_space,
                                          ParFiniteElementSpace &column_space,
                                          SparseMatrix &local)
{
   const HypreParMatrix diagonal(
      row_space.GetComm(), row_space.GlobalVSize(), column_space.GlobalVSize(),
      row_space.GetDofOffsets(), column_space.GetDofOffsets(), &local);
   if (row_space.GetNRanks() == 1 && row_space.Conforming() &&
       column_space.Conforming())
   {
      return std::make_unique<HypreParMatrix>(diagonal);
   }
   const std::unique_ptr<HypreParMatrix> columns(
      ParMult(&diagonal, column_space.Dof_TrueDof_Matrix()));
   const std::unique_ptr<HypreParMatrix> transpose(
      row_space.Dof_TrueDof_Matrix()->Transpose());
   return std::unique_ptr<HypreParMatrix>(
      ParMult(transpose.get(), columns.get(), true));
}

} // namespace synovia
