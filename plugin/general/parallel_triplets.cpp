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

/// Triplets of this rank's rows, as each rank sent them.
class LocalTriplets
{
public:
   LocalTriplets(MPI_Comm comm, const std::vector<Triplet> &triplets,
                 const HYPRE_BigInt *row_offsets)
      : mine(triplets), begin(row_offsets[0]), end(row_offsets[1])
   {
      int size;
      MPI_Comm_size(comm, &size);
      MPI_Comm_rank(comm, &rank);
      std::vector<HYPRE_BigInt> ends(size);
      MPI_Allgather(&end, sizeof(HYPRE_BigInt), MPI_BYTE, ends.data(),
                    sizeof(HYPRE_BigInt), MPI_BYTE, comm);
      std::vector<std::vector<Triplet>> outgoing(size);
      for (const Triplet &triplet : mine)
      {
         if (!IsHere(triplet))
         {
            const auto owner =
               std::upper_bound(ends.begin(), ends.end(), triplet.row) -
               ends.begin();
            outgoing[owner].push_back(triplet);
         }
      }
      others = Exchange(std::move(outgoing), comm);
   }

   /// Calls @a visit(local row, column, value) rank by rank.
   template <typename Visit>
   void ForEach(const Visit &visit) const
   {
      for (int r = 0; r < static_cast<int>(others.size()); r++)
      {
         for (const Triplet &triplet : r == rank ? mine : others[r])
         {
            if (IsHere(triplet))
            {
               visit(static_cast<int>(triplet.row - begin), triplet.column,
                     triplet.value);
            }
         }
      }
   }

private:
   bool IsHere(const Triplet &triplet) const
   {
      return begin <= triplet.row && triplet.row < end;
   }

   const std::vector<Triplet> &mine;
   HYPRE_BigInt begin;
   HYPRE_BigInt end;
   int rank = 0;
   /// What this rank sent to itself is left empty.
   std::vector<std::vector<Triplet>> others;
};

/// Adds up entries of a row that meet.
class RowSum
{
public:
   RowSum(HYPRE_BigInt first_column, HYPRE_BigInt last_column)
      : first(first_column),
        places(std::max<HYPRE_BigInt>(0, last_column - first_column + 1), 0)
   {
   }
   /// Leaves each column once, ascending, at the beginning; returns how many.
   std::ptrdiff_t AddUp(Entry *begin, Entry *end)
   {
      std::ptrdiff_t count = 0;
      for (const Entry *entry = begin; entry != end; entry++)
      {
         // A place may belong to another row, unless the column agrees.
         int &place = places[entry->column - first];
         if (place < count && begin[place].column == entry->column)
         {
            begin[place].value += entry->value;
         }
         else
         {
            place = static_cast<int>(count);
            begin[count++] = *entry;
         }
      }
      std::sort(begin, begin + count,
                [](const Entry &a, const Entry &b)
                { return a.column < b.column; });
      return count;
   }

private:
   HYPRE_BigInt first;
   std::vector<int> places;
};
} // namespace

std::unique_ptr<HypreParMatrix>
AssembleTriplets(MPI_Comm comm, const std::vector<Triplet> &triplets,
                 HYPRE_BigInt *row_offsets, HYPRE_BigInt rows,
                 HYPRE_BigInt *column_offsets, HYPRE_BigInt columns)
{
   MFEM_VERIFY(HYPRE_AssumedPartitionCheck(),
               "hypre must be built with assumed partitions, its default");
   const LocalTriplets local(comm, triplets, row_offsets);

   // Sorted into rows first: sorting all at once takes several times as long.
   const int local_rows = static_cast<int>(row_offsets[1] - row_offsets[0]);
   std::vector<int> starts(local_rows + 1, 0);
   HYPRE_BigInt first_column = columns;
   HYPRE_BigInt last_column = -1;
   local.ForEach(
      [&](int row, HYPRE_BigInt column, real_t)
      {
         starts[row + 1]++;
         first_column = std::min(first_column, column);
         last_column = std::max(last_column, column);
      });
   std::partial_sum(starts.begin(), starts.end(), starts.begin());
   std::vector<Entry> entries(starts.back());
   std::vector<int> next(starts.begin(), starts.end() - 1);
   local.ForEach(
      [&](int row, HYPRE_BigInt column, real_t value) {
         entries[next[row]++] = {column, value};
      });
   RowSum sum(first_column, last_column);
   std::vector<HYPRE_BigInt> column_numbers;
   std::vector<real_t> values;
   column_numbers.reserve(entries.size());
   values.reserve(entries.size());
   int begin = 0;
   for (int i = 0; i < local_rows; i++)
   {
      Entry *row = entries.data() + begin;
      begin = starts[i + 1];
      const std::ptrdiff_t length = sum.AddUp(row, entries.data() + begin);
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
