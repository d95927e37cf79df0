#pragma once

#include "mfem.hpp"

namespace synovia
{

/// Resources that processes have used since they started.
struct ResourceUse
{
   /// Peak of the memory in use, summed over ranks, whose peaks need not be at
   /// the same time, and of the rank with the highest one (MiB).
   mfem::real_t memory_sum = 0.0;
   mfem::real_t memory_max = 0.0;
   /// Processor time of all ranks (s).
   mfem::real_t cpu_seconds = 0.0;
};

/// Peak of the memory that this rank has had in use (MiB).
mfem::real_t GetPeakMemory();

/// Of all ranks so far, as the operating system counts it. Collective.
ResourceUse GetResourceUse(MPI_Comm comm);

/// Memory of all machines that the ranks are on (bytes), in use or not; without
/// bound where the operating system doesn't say. Collective.
mfem::real_t PhysicalMemory(MPI_Comm comm);

} // namespace synovia
