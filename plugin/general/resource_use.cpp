#include "synovia/general/resource_use.hpp"
#include "synovia/general/reduce.hpp"

#include <limits>
#include <sys/resource.h>
#include <unistd.h>

namespace synovia
{

using namespace mfem;

namespace
{
rusage ResourcesOfProcess()
{
   rusage mine{};
   getrusage(RUSAGE_SELF, &mine);
   return mine;
}
} // namespace

real_t GetPeakMemory()
{
   // Linux counts kilobytes, macOS bytes.
#ifdef __APPLE__
   constexpr real_t unit = 1.0 / (1024.0 * 1024.0);
#else
   constexpr real_t unit = 1.0 / 1024.0;
#endif
   return unit * static_cast<real_t>(ResourcesOfProcess().ru_maxrss);
}

ResourceUse GetResourceUse(MPI_Comm comm)
{
   const rusage mine = ResourcesOfProcess();
   const real_t memory = GetPeakMemory();
   const auto seconds = [](const timeval &time)
   { return static_cast<real_t>(time.tv_sec) + 1e-6 * time.tv_usec; };
   ResourceUse use;
   use.memory_sum = SumOverRanks(memory, comm);
   use.memory_max = MaxOverRanks(memory, comm);
   use.cpu_seconds =
      SumOverRanks(seconds(mine.ru_utime) + seconds(mine.ru_stime), comm);
   return use;
}

real_t PhysicalMemory(MPI_Comm comm)
{
   MPI_Comm machine = MPI_COMM_NULL;
   MPI_Comm_split_type(comm, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
   int rank = 0;
   MPI_Comm_rank(machine, &rank);
   MPI_Comm_free(&machine);
   // One rank of each machine counts it.
   real_t mine = 0.0;
   if (rank == 0)
   {
      const auto pages = static_cast<real_t>(sysconf(_SC_PHYS_PAGES));
      const auto size = static_cast<real_t>(sysconf(_SC_PAGESIZE));
      mine = pages > 0.0 && size > 0.0
                ? pages * size
                : std::numeric_limits<real_t>::infinity();
   }
   return SumOverRanks(mine, comm);
}

} // namespace synovia
