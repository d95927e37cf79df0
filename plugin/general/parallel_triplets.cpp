#include "synovia/general/parallel_triplets.hpp"
#include "synovia/general/exchange.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace synovia
{

using namespace mfem;

namespace
{
struct Entry
{
   HYPRE_BigInt column;
   real_t value;
};

// Sorts entries of one row by column and adds up those that meet; returns how
// many are left, at the beginning.
std::ptrdiff_t AddUp(Entry *begin, Entry *end)
{
   if (begin == end)
   {
      return 0;
   }
   std::sort(begin, end,
             [](const Entry &a, const Entry &b)
             { return a.column < b.column; });
   Entry *last = begin;
   for (Entry *entry = begin + 1; entry != end; entry++)
   {
      if (entry->column == last->column)
      {
         last->value += entry->value;
      }
      else
      {
         *++last = *entry;
      }
   }
   return last + 1 - begin;
}
} // namespace

std::unique_ptr<HypreParMatrix>
AssembleTriplets(MPI_Comm comm, const std::vector<Triplet> &triplets,
                 HYPRE_BigInt *row_offsets, HYPRE_BigInt rows,
                 HYPRE_BigInt *column_offsets, HYPRE_BigInt columns)
{
   MFEM_VERIFY(HYPRE_AssumedPartitionCheck(),
               "hypre must be built with assumed partitions, its default");
   int size;
   MPI_Comm_size(comm, &size);
   std::vector<HYPRE_BigInt> ends(size);
   MPI_Allgather(&row_offsets[1], sizeof(HYPRE_BigInt), MPI_BYTE, ends.data(),
                 sizeof(HYPRE_BigInt), MPI_BYTE, comm);
   std::vector<std::vector<Triplet>> outgoing(size);
   for (const Triplet &triplet : triplets)
   {
      const auto owner =
         std::upper_bound(ends.begin(), ends.end(), triplet.row) - ends.begin();
      outgoing[owner].push_back(triplet);
   }
   const std::vector<std::vector<Triplet>> incoming =
      Exchange(std::move(outgoing), comm);

   // Sorted into rows first: sorting all at once takes several times as long.
   const int local_rows = static_cast<int>(row_offsets[1] - row_offsets[0]);
   std::vector<int> starts(local_rows + 1, 0);
   for (const std::vector<Triplet> &part : incoming)
   {
      for (const Triplet &triplet : part)
      {
         starts[triplet.row - row_offsets[0] + 1]++;
      }
   }
   std::partial_sum(starts.begin(), starts.end(), starts.begin());
   std::vector<Entry> entries(starts.back());
   std::vector<int> next(starts.begin(), starts.end() - 1);
   for (const std::vector<Triplet> &part : incoming)
   {
      for (const Triplet &triplet : part)
      {
         entries[next[triplet.row - row_offsets[0]]++] = {triplet.column,
                                                          triplet.value};
      }
   }
   std::vector<HYPRE_BigInt> column_numbers;
   std::vector<real_t> values;
   column_numbers.reserve(entries.size());
   values.reserve(entries.size());
   int begin = 0;
   for (int i = 0; i < local_rows; i++)
   {
      Entry *row = entries.data() + begin;
      begin = starts[i + 1];
      const std::ptrdiff_t length = AddUp(row, entries.data() + begin);
      for (const Entry *entry = row; entry != row + length; entry++)
      {
         column_numbers.push_back(entry->column);
         values.push_back(entry->value);
      }
      starts[i + 1] = static_cast<int>(values.size());
   }
   return std::make_unique<HypreParMatrix>(
      comm, local_rows, rows, columns, starts.data(), column_numbers.data(),
      values.data(), row_offsets, column_offsets);
}

} // namespace synovia
