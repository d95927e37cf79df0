#pragma once

#include "mfem.hpp"

namespace synovia
{

/// Collective: the largest and the sum over ranks.
inline mfem::real_t MaxOverRanks(mfem::real_t value, MPI_Comm comm)
{
   MPI_Allreduce(MPI_IN_PLACE, &value, 1,
                 mfem::MPITypeMap<mfem::real_t>::mpi_type, MPI_MAX, comm);
   return value;
}

inline mfem::real_t SumOverRanks(mfem::real_t value, MPI_Comm comm)
{
   MPI_Allreduce(MPI_IN_PLACE, &value, 1,
                 mfem::MPITypeMap<mfem::real_t>::mpi_type, MPI_SUM, comm);
   return value;
}

inline bool AnyRank(bool value, MPI_Comm comm)
{
   return MaxOverRanks(value ? 1.0 : 0.0, comm) > 0.5;
}

/// The largest value over ranks.
struct RankedValue
{
   double value;
   /// The lowest of the ranks that have it.
   int rank;
   /// Whether this rank is the one.
   bool here;
};

/// Collective.
inline RankedValue LargestOverRanks(double value, MPI_Comm comm)
{
   int self;
   MPI_Comm_rank(comm, &self);
   struct
   {
      double value;
      int rank;
   } largest = {value, self};
   MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE_INT, MPI_MAXLOC, comm);
   return {largest.value, largest.rank, largest.rank == self};
}

} // namespace synovia
