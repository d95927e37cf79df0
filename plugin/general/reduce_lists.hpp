#pragma once

#include "mfem.hpp"

#include <vector>

namespace synovia
{

/// Collective: replaces each value by the one over all ranks, whose lists have
/// the same length.
inline void ReduceOverRanks(std::vector<mfem::real_t> &values, MPI_Op op,
                            MPI_Comm comm)
{
   MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()),
                 mfem::MPITypeMap<mfem::real_t>::mpi_type, op, comm);
}

inline void SumOverRanks(std::vector<mfem::real_t> &values, MPI_Comm comm)
{
   ReduceOverRanks(values, MPI_SUM, comm);
}

inline void MinOverRanks(std::vector<mfem::real_t> &values, MPI_Comm comm)
{
   ReduceOverRanks(values, MPI_MIN, comm);
}

inline void MaxOverRanks(std::vector<mfem::real_t> &values, MPI_Comm comm)
{
   ReduceOverRanks(values, MPI_MAX, comm);
}

} // namespace synovia
