#include "general/resource_use.hpp"
#include "general/reduce.hpp"

#include <sys/resource.h>

namespace synovia
{

using namespace mfem;

ResourceUse GetResourceUse(MPI_Comm comm)
{
   rusage mine{};
   getrusage(RUSAGE_SELF, &mine);
   // Linux counts kilobytes, macOS bytes.
#ifdef __APPLE__
   constexpr real_t unit = 1.0 / (1024.0 * 1024.0);
#else
   constexpr real_t unit = 1.0 / 1024.0;
#endif
   const real_t memory = unit * static_cast<real_t>(mine.ru_maxrss);
   const auto seconds = [](const timeval &time)
   { return static_cast<real_t>(time.tv_sec) + 1e-6 * time.tv_usec; };
   ResourceUse use;
   use.memory_sum = SumOverRanks(memory, comm);
   use.memory_max = MaxOverRanks(memory, comm);
   use.cpu_seconds =
      SumOverRanks(seconds(mine.ru_utime) + seconds(mine.ru_stime), comm);
   return use;
}

} // namespace synovia
