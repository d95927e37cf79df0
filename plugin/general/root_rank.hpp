#pragma once

#include "synovia/general/error.hpp"

#include <mpi.h>

#include <string>

namespace synovia
{

/// Whether this is rank 0, which reads and writes files.
inline bool IsRoot(MPI_Comm comm)
{
   int rank = 0;
   MPI_Comm_rank(comm, &rank);
   return rank == 0;
}

/// Collective over @a comm: runs @a work, which is not collective, on each
/// rank, and throws on all of them what it throws on any, as Error.
template <typename Work>
void OnEachRank(MPI_Comm comm, Work work)
{
   std::string message;
   try
   {
      work();
   }
   catch (const std::exception &error)
   {
      message = error.what();
   }
   ThrowIfAny(comm, message);
}

/// The same, but for rank 0 only.
template <typename Work>
void OnRoot(MPI_Comm comm, Work work)
{
   OnEachRank(comm,
              [&]()
              {
                 if (IsRoot(comm))
                 {
                    work();
                 }
              });
}

/// Collective: what rank 0 has.
inline bool OfRoot(bool value, MPI_Comm comm)
{
   int flag = value ? 1 : 0;
   MPI_Bcast(&flag, 1, MPI_INT, 0, comm);
   return flag != 0;
}

/// Collective: gives all ranks the text of rank 0.
inline void Broadcast(std::string &text, MPI_Comm comm)
{
   int length = static_cast<int>(text.size());
   MPI_Bcast(&length, 1, MPI_INT, 0, comm);
   text.resize(length);
   MPI_Bcast(text.data(), length, MPI_CHAR, 0, comm);
}

} // namespace synovia
