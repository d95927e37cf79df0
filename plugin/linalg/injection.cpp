#include "synovia/linalg/injection.hpp"

namespace synovia
{

using namespace mfem;

std::unique_ptr<HypreParMatrix> Injection(const HypreParMatrix &matrix,
                                          const Array<int> &rows)
{
   MPI_Comm comm = matrix.GetComm();
   HYPRE_BigInt local = rows.Size();
   HYPRE_BigInt end = 0;
   MPI_Scan(&local, &end, 1, HYPRE_MPI_BIG_INT, MPI_SUM, comm);
   HYPRE_BigInt columns = 0;
   MPI_Allreduce(&local, &columns, 1, HYPRE_MPI_BIG_INT, MPI_SUM, comm);
   HYPRE_BigInt column_offsets[2] = {end - local, end};

   SparseMatrix injection(matrix.Height(), rows.Size());
   for (int j = 0; j < rows.Size(); j++)
   {
      injection.Set(rows[j], j, 1.0);
   }
   injection.Finalize();
   HYPRE_BigInt row_offsets[2] = {matrix.RowPart()[0], matrix.RowPart()[1]};
   const HypreParMatrix borrowed(comm, matrix.GetGlobalNumRows(), columns,
                                 row_offsets, column_offsets, &injection);
   // A copy owns its offsets and entries.
   return std::make_unique<HypreParMatrix>(borrowed);
}

} // namespace synovia
