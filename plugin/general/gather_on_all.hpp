#pragma once

#include "synovia/general/exchange.hpp"

namespace synovia
{

/// Collective. What all ranks have, in their order, on each of them: for short
/// lists.
template <typename T>
std::vector<T> GatherOnAll(const std::vector<T> &mine, MPI_Comm comm)
{
   int ranks = 1;
   MPI_Comm_size(comm, &ranks);
   std::vector<T> all;
   for (const auto &part :
        Exchange(std::vector<std::vector<T>>(ranks, mine), comm))
   {
      all.insert(all.end(), part.begin(), part.end());
   }
   return all;
}

} // namespace synovia
