#pragma once

#include <mpi.h>

#include <algorithm>
#include <vector>

namespace synovia
{

/// Lists that go from rank 0 to the others, of types whose bytes may be copied.
/// The ranks of one run are taken to agree on the sizes and the order of bytes.
/// Lists may be longer than MPI counts, which is in int.
namespace rank_zero_lists
{
constexpr long long most_bytes = 1 << 30;

/// Calls @a transfer(data, bytes) for the parts of a list, in order.
template <typename T, typename Transfer>
void ForParts(std::vector<T> &list, const Transfer &transfer)
{
   const auto size = static_cast<long long>(list.size());
   const long long most = most_bytes / static_cast<long long>(sizeof(T));
   for (long long i = 0; i < size; i += most)
   {
      transfer(list.data() + i,
               static_cast<int>(std::min(most, size - i) * sizeof(T)));
   }
}
} // namespace rank_zero_lists

/// Collective. Gives every rank the list of rank 0.
template <typename T>
void BroadcastList(std::vector<T> &list, MPI_Comm comm)
{
   long long size = list.size();
   MPI_Bcast(&size, 1, MPI_LONG_LONG, 0, comm);
   list.resize(size);
   rank_zero_lists::ForParts(list, [&](T *data, int bytes)
                             { MPI_Bcast(data, bytes, MPI_BYTE, 0, comm); });
}

/// Collective. Gives each rank the list that @a list_of(rank) is on rank 0,
/// where no more than one of them is kept at a time.
template <typename T, typename ListOf>
std::vector<T> ScatterLists(const ListOf &list_of, MPI_Comm comm)
{
   constexpr int tag = 0;
   int rank = 0;
   int ranks = 1;
   MPI_Comm_rank(comm, &rank);
   MPI_Comm_size(comm, &ranks);
   std::vector<T> list;
   if (rank == 0)
   {
      for (int to = 1; to < ranks; to++)
      {
         list = list_of(to);
         const long long size = list.size();
         MPI_Send(&size, 1, MPI_LONG_LONG, to, tag, comm);
         rank_zero_lists::ForParts(
            list, [&](T *data, int bytes)
            { MPI_Send(data, bytes, MPI_BYTE, to, tag, comm); });
      }
      return list_of(0);
   }
   long long size = 0;
   MPI_Recv(&size, 1, MPI_LONG_LONG, 0, tag, comm, MPI_STATUS_IGNORE);
   list.resize(size);
   rank_zero_lists::ForParts(
      list, [&](T *data, int bytes)
      { MPI_Recv(data, bytes, MPI_BYTE, 0, tag, comm, MPI_STATUS_IGNORE); });
   return list;
}

} // namespace synovia
