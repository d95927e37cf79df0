#include "synovia/linalg/coupled_rows.hpp"
#include "synovia/linalg/local_rows.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
bool IsLone(const SparseMatrix &rows, int row, int diagonal)
{
   for (int k = rows.GetI()[row]; k < rows.GetI()[row + 1]; k++)
   {
      if (rows.GetJ()[k] != diagonal && rows.GetData()[k] != 0.0)
      {
         return false;
      }
   }
   return true;
}

// By global row, of all ranks.
std::vector<char> FindLone(const SparseMatrix &rows, int first, int size,
                           MPI_Comm comm)
{
   const int count = rows.Height();
   std::vector<char> mine(count);
   for (int i = 0; i < count; i++)
   {
      mine[i] = IsLone(rows, i, first + i);
   }
   int ranks = 1;
   MPI_Comm_size(comm, &ranks);
   std::vector<int> counts(ranks);
   std::vector<int> starts(ranks);
   MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, comm);
   MPI_Allgather(&first, 1, MPI_INT, starts.data(), 1, MPI_INT, comm);
   std::vector<char> all(size);
   MPI_Allgatherv(mine.data(), count, MPI_CHAR, all.data(), counts.data(),
                  starts.data(), MPI_CHAR, comm);
   return all;
}

template <typename Keeps>
void KeepEntries(SparseMatrix &rows, const Keeps &keeps)
{
   int *const begins = rows.HostReadWriteI();
   int *const columns = rows.HostReadWriteJ();
   real_t *const entries = rows.HostReadWriteData();
   int kept = 0;
   int begin = 0;
   for (int i = 0; i < rows.Height(); i++)
   {
      const int end = begins[i + 1];
      for (int k = begin; k < end; k++)
      {
         if (entries[k] != 0.0 || keeps(i, columns[k]))
         {
            columns[kept] = columns[k];
            entries[kept] = entries[k];
            kept++;
         }
      }
      begin = end;
      begins[i + 1] = kept;
   }
}
} // namespace

SparseMatrix CoupledRows(const HypreParMatrix &matrix, DroppedZeros dropped)
{
   SparseMatrix rows = LocalRows(matrix);
   const int first = static_cast<int>(matrix.RowPart()[0]);
   if (dropped == DroppedZeros::all)
   {
      KeepEntries(rows,
                  [&](int row, int column) { return column == first + row; });
      return rows;
   }
   const int size = static_cast<int>(matrix.GetGlobalNumRows());
   const std::vector<char> lone = FindLone(rows, first, size, matrix.GetComm());
   KeepEntries(rows,
               [&](int row, int column) {
                  return column == first + row ||
                         (!lone[first + row] && !lone[column]);
               });
   return rows;
}

} // namespace synovia
