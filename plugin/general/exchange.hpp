#pragma once

#include <mpi.h>

#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

namespace synovia
{

/// Collective. Sends @a outgoing[r] to each rank r and returns what each rank
/// sent here. What a rank sends to itself isn't copied, if @a outgoing is
/// moved.
template <typename T>
std::vector<std::vector<T>> Exchange(std::vector<std::vector<T>> outgoing,
                                     MPI_Comm comm)
{
   static_assert(std::is_trivially_copyable<T>::value,
                 "elements travel as bytes");
   const int size = static_cast<int>(outgoing.size());
   int self;
   MPI_Comm_rank(comm, &self);
   std::vector<std::vector<T>> incoming(size);
   std::swap(incoming[self], outgoing[self]);
   std::vector<int> counts(size);
   for (int r = 0; r < size; r++)
   {
      counts[r] = static_cast<int>(outgoing[r].size());
   }
   std::vector<int> incoming_counts(size);
   MPI_Alltoall(counts.data(), 1, MPI_INT, incoming_counts.data(), 1, MPI_INT,
                comm);
   MPI_Datatype type;
   MPI_Type_contiguous(static_cast<int>(sizeof(T)), MPI_BYTE, &type);
   MPI_Type_commit(&type);
   std::vector<MPI_Request> requests;
   for (int r = 0; r < size; r++)
   {
      if (incoming_counts[r] > 0)
      {
         incoming[r].resize(incoming_counts[r]);
         requests.emplace_back();
         MPI_Irecv(incoming[r].data(), incoming_counts[r], type, r, 0, comm,
                   &requests.back());
      }
   }
   for (int r = 0; r < size; r++)
   {
      if (counts[r] > 0)
      {
         requests.emplace_back();
         MPI_Isend(outgoing[r].data(), counts[r], type, r, 0, comm,
                   &requests.back());
      }
   }
   MPI_Waitall(static_cast<int>(requests.size()), requests.data(),
               MPI_STATUSES_IGNORE);
   MPI_Type_free(&type);
   return incoming;
}

} // namespace synovia
