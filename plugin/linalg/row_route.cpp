#include "synovia/linalg/row_route.hpp"
#include "synovia/general/exchange.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

void RowRoute::Parcels::Append(std::size_t count)
{
   begins.push_back(counts.empty() ? 0 : begins.back() + counts.back());
   counts.push_back(static_cast<int>(count));
   entries.SetSize(begins.back() + counts.back());
}

RowRoute::RowRoute(const std::vector<HYPRE_BigInt> &rows,
                   HYPRE_BigInt first_row, MPI_Comm comm_)
   : comm(comm_)
{
   int ranks = 1;
   MPI_Comm_size(comm, &ranks);
   std::vector<HYPRE_BigInt> first_rows(ranks);
   MPI_Allgather(&first_row, 1, HYPRE_MPI_BIG_INT, first_rows.data(), 1,
                 HYPRE_MPI_BIG_INT, comm);

   std::vector<std::vector<HYPRE_BigInt>> wanted(ranks);
   std::vector<std::vector<int>> places(ranks);
   for (std::size_t i = 0; i < rows.size(); i++)
   {
      // If ranks have the same first row, only the last one owns rows.
      const auto next =
         std::upper_bound(first_rows.begin(), first_rows.end(), rows[i]);
      const auto owner = next - first_rows.begin() - 1;
      wanted[owner].push_back(rows[i]);
      places[owner].push_back(static_cast<int>(i));
   }
   for (const std::vector<int> &part : places)
   {
      outgoing.Append(part.size());
      places_before.insert(places_before.end(), part.begin(), part.end());
   }
   for (const std::vector<HYPRE_BigInt> &part :
        Exchange(std::move(wanted), comm))
   {
      incoming.Append(part.size());
      for (const HYPRE_BigInt row : part)
      {
         places_owned.push_back(static_cast<int>(row - first_row));
      }
   }
}

void RowRoute::Bring(const real_t *entries, Vector &owned)
{
   for (std::size_t i = 0; i < places_before.size(); i++)
   {
      outgoing.entries[static_cast<int>(i)] = entries[places_before[i]];
   }
   MPI_Alltoallv(outgoing.entries.GetData(), outgoing.counts.data(),
                 outgoing.begins.data(), MPITypeMap<real_t>::mpi_type,
                 incoming.entries.GetData(), incoming.counts.data(),
                 incoming.begins.data(), MPITypeMap<real_t>::mpi_type, comm);
   real_t *to = owned.HostWrite();
   for (std::size_t i = 0; i < places_owned.size(); i++)
   {
      to[places_owned[i]] = incoming.entries[static_cast<int>(i)];
   }
}

} // namespace synovia
