#include "synovia/linalg/bytes_read.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
double BytesOf(const hypre_CSRMatrix *part)
{
   constexpr double entry = sizeof(HYPRE_Complex) + sizeof(HYPRE_Int);
   return entry * hypre_CSRMatrixNumNonzeros(part) +
          sizeof(HYPRE_Int) * (hypre_CSRMatrixNumRows(part) + 1.0);
}

double BytesOf(hypre_ParCSRMatrix *matrix)
{
   return BytesOf(hypre_ParCSRMatrixDiag(matrix)) +
          BytesOf(hypre_ParCSRMatrixOffd(matrix));
}
} // namespace

double BytesOf(const HypreParMatrix *matrix)
{
   return matrix ? BytesOf(static_cast<hypre_ParCSRMatrix *>(*matrix)) : 0.0;
}

double BytesOfCycle(const HypreBoomerAMG &amg)
{
   constexpr double products_with_matrix = 3.0;
   constexpr double products_with_interpolation = 2.0;
   const HYPRE_Solver solver = amg;
   auto *data = reinterpret_cast<hypre_ParAMGData *>(solver);
   hypre_ParCSRMatrix **matrices = hypre_ParAMGDataAArray(data);
   if (!matrices)
   {
      return 0.0;
   }
   double bytes = 0.0;
   const int levels = hypre_ParAMGDataNumLevels(data);
   for (int level = 0; level < levels; level++)
   {
      bytes += products_with_matrix * BytesOf(matrices[level]);
      if (level + 1 < levels)
      {
         bytes += products_with_interpolation *
                  BytesOf(hypre_ParAMGDataPArray(data)[level]);
      }
   }
   return bytes;
}

} // namespace synovia
