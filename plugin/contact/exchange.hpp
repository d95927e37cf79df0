#pragma once

#include <mpi.h>

#include <cstddef>
#include <type_traits>
#include <vector>

namespace synovia
{

/// Collective. Sends @a outgoing[r] to each rank r and returns what each rank
/// sent here.
template <typename T>
std::vector<std::vector<T>>
Exchange(const std::vector<std::vector<T>> &outgoing, MPI_Comm comm)
{
   static_assert(std::is_trivially_copyable<T>::value,
                 "elements travel as bytes");
   const int size = static_cast<int>(outgoing.size());
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
   std::vector<std::vector<T>> incoming(size);
   std::vector<MPI_Request> requests;
   for (int r = 0; r < size; r++)
   {
      incoming[r].resize(incoming_counts[r]);
      if (incoming_counts[r] > 0)
      {
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
