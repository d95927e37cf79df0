#include "synovia/linalg/coupled_rows.hpp"
#include "synovia/linalg/local_rows.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
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

CoupledMatrix CoupledRows(const HypreParMatrix &matrix, DroppedZeros dropped)
{
   const int first = static_cast<int>(matrix.RowPart()[0]);
   CoupledMatrix coupled(LocalRows(matrix), first, matrix.GetComm());
   const LoneUnknowns &lone = coupled.lone;
   KeepEntries(coupled.rows,
               [&](int row, int column)
               {
                  return column == first + row ||
                         (dropped == DroppedZeros::of_lone_unknowns &&
                          !lone.Has(first + row) && !lone.Has(column));
               });
   return coupled;
}

} // namespace synovia
