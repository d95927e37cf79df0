#include "contact/parallel_triplets.hpp"
#include "contact/exchange.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

namespace
{
void SortAndAddUp(std::vector<Triplet> &triplets)
{
   std::sort(triplets.begin(), triplets.end(),
             [](const Triplet &a, const Triplet &b) {
                return a.row < b.row || (a.row == b.row && a.column < b.column);
             });
   size_t last = 0;
   for (size_t i = 1; i < triplets.size(); i++)
   {
      if (triplets[i].row == triplets[last].row &&
          triplets[i].column == triplets[last].column)
      {
         triplets[last].value += triplets[i].value;
      }
      else
      {
         triplets[++last] = triplets[i];
      }
   }
   if (!triplets.empty())
   {
      triplets.resize(last + 1);
   }
}
} // namespace

std::unique_ptr<HypreParMatrix>
AssembleTriplets(MPI_Comm comm, std::vector<Triplet> triplets,
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
   SortAndAddUp(triplets);
   std::vector<std::vector<Triplet>> outgoing(size);
   for (const Triplet &triplet : triplets)
   {
      const auto owner =
         std::upper_bound(ends.begin(), ends.end(), triplet.row) - ends.begin();
      outgoing[owner].push_back(triplet);
   }
   std::vector<Triplet> mine;
   for (const auto &incoming : Exchange(outgoing, comm))
   {
      mine.insert(mine.end(), incoming.begin(), incoming.end());
   }
   SortAndAddUp(mine);

   const int local_rows = static_cast<int>(row_offsets[1] - row_offsets[0]);
   std::vector<int> starts(local_rows + 1, 0);
   std::vector<HYPRE_BigInt> column_numbers;
   std::vector<real_t> values;
   column_numbers.reserve(mine.size());
   values.reserve(mine.size());
   for (const Triplet &triplet : mine)
   {
      starts[triplet.row - row_offsets[0] + 1]++;
      column_numbers.push_back(triplet.column);
      values.push_back(triplet.value);
   }
   for (int i = 0; i < local_rows; i++)
   {
      starts[i + 1] += starts[i];
   }
   return std::make_unique<HypreParMatrix>(
      comm, local_rows, rows, columns, starts.data(), column_numbers.data(),
      values.data(), row_offsets, column_offsets);
}

} // namespace synovia
