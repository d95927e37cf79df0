#include "synovia/linalg/umfpack_solver.hpp"

#ifdef MFEM_USE_SUITESPARSE

#include "synovia/general/text.hpp"
#include "synovia/linalg/coupled_rows.hpp"
#include "synovia/linalg/direct_solver.hpp"

#include <cmath>
#include <string>

namespace synovia
{

using namespace mfem;

namespace
{
void FreeSymbolic(void *factors)
{
   umfpack_dl_free_symbolic(&factors);
}

void FreeNumeric(void *factors)
{
   umfpack_dl_free_numeric(&factors);
}
} // namespace

UmfpackSolver::UmfpackSolver(int memory_limit_)
   : memory_limit(memory_limit_), symbolic(nullptr, &FreeSymbolic),
     numeric(nullptr, &FreeNumeric)
{
   umfpack_dl_defaults(control.data());
   control[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;
}

void UmfpackSolver::SetOperator(const Operator &op)
{
   CoupledMatrix coupled = CoupledRows(dynamic_cast<const HypreParMatrix &>(op),
                                       DroppedZeros::of_lone_unknowns);
   SparseMatrix &matrix = coupled.rows;
   MFEM_VERIFY(matrix.Height() == matrix.Width(),
               "UMFPACK needs all rows of a square matrix");
   matrix.SortColumnIndices();
   height = width = matrix.Height();
   numeric.reset();
   const int count = matrix.NumNonZeroElems();
   std::vector<Index> new_begins(matrix.GetI(), matrix.GetI() + height + 1);
   std::vector<Index> new_indices(matrix.GetJ(), matrix.GetJ() + count);
   entries.assign(matrix.GetData(), matrix.GetData() + count);
   if (!symbolic || new_begins != begins || new_indices != indices)
   {
      begins = std::move(new_begins);
      indices = std::move(new_indices);
      Analyze();
   }
   Factorize();
}

std::string UmfpackSolver::Failing(const std::string &task) const
{
   return "UMFPACK could not " + task + " (" + std::to_string(height) +
          " unknowns): ";
}

void UmfpackSolver::Analyze()
{
   symbolic.reset();
   std::array<double, UMFPACK_INFO> info;
   void *made = nullptr;
   const Index status =
      umfpack_dl_symbolic(height, height, begins.data(), indices.data(),
                          entries.data(), &made, control.data(), info.data());
   symbolic.reset(made);
   if (status != UMFPACK_OK)
   {
      throw FactorizationError(Failing("order the matrix") +
                               (status == UMFPACK_ERROR_out_of_memory
                                   ? "out of memory"
                                   : "status " + std::to_string(status)));
   }
   foreseen_memory =
      1e-6 * info[UMFPACK_PEAK_MEMORY_ESTIMATE] * info[UMFPACK_SIZE_OF_UNIT];
}

void UmfpackSolver::Factorize()
{
   const std::string who = Failing("factorize the matrix");
   if (memory_limit > 0.0 && foreseen_memory > memory_limit)
   {
      throw FactorizationError(who + "it may need " +
                               Megabytes(foreseen_memory) + ", " +
                               Megabytes(foreseen_memory - memory_limit) +
                               " more than direct_memory_limit (" +
                               Megabytes(memory_limit) + ") allows");
   }
   void *made = nullptr;
   const Index status =
      umfpack_dl_numeric(begins.data(), indices.data(), entries.data(),
                         symbolic.get(), &made, control.data(), nullptr);
   numeric.reset(made);
   if (status == UMFPACK_OK)
   {
      return;
   }
   numeric.reset();
   if (status == UMFPACK_WARNING_singular_matrix)
   {
      throw FactorizationError(who + "the matrix is singular");
   }
   if (status == UMFPACK_ERROR_out_of_memory)
   {
      throw FactorizationError(who + "out of memory; it may need " +
                               Megabytes(foreseen_memory));
   }
   throw FactorizationError(who + "status " + std::to_string(status));
}

void UmfpackSolver::Mult(const Vector &x, Vector &y) const
{
   MFEM_VERIFY(numeric, "there is no factorization");
   // UMFPACK takes rows for columns.
   const Index status = umfpack_dl_solve(
      UMFPACK_At, begins.data(), indices.data(), entries.data(), y.HostWrite(),
      x.HostRead(), numeric.get(), control.data(), nullptr);
   if (status != UMFPACK_OK)
   {
      throw FactorizationError(Failing("solve for a right side") + "status " +
                               std::to_string(status));
   }
}

} // namespace synovia

#endif
