#include "synovia/linalg/coupled_rows.hpp"
#include "synovia/general/gather_on_all.hpp"
#include "synovia/linalg/local_rows.hpp"

#include <algorithm>

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

// Global rows of all ranks, ascending.
std::vector<int> FindLone(const SparseMatrix &rows, int first, MPI_Comm comm)
{
   std::vector<int> mine;
   for (int i = 0; i < rows.Height(); i++)
   {
      if (IsLone(rows, i, first + i))
      {
         mine.push_back(first + i);
      }
   }
   return GatherOnAll(mine, comm);
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
   const std::vector<int> lone = FindLone(rows, first, matrix.GetComm());
   const auto is_lone = [&](int row)
   { return std::binary_search(lone.begin(), lone.end(), row); };
   KeepEntries(rows,
               [&](int row, int column)
               {
                  return column == first + row ||
                         (!is_lone(first + row) && !is_lone(column));
               });
   return rows;
}

} // namespace synovia
