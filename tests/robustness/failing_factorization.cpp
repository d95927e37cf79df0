// Preloaded into a program, gives one of MUMPS' factorizations a megabyte of
// memory on each rank, as where others take a machine's memory for a while; all
// others have what they were given.

#include <mfem.hpp>

#include <cstdlib>
#include <dlfcn.h>

extern "C" void dmumps_c(DMUMPS_STRUC_C *data)
{
   constexpr int factorize = 2;
   constexpr int memory_per_rank = 23;
   using Function = void (*)(DMUMPS_STRUC_C *);
   static const auto mumps =
      reinterpret_cast<Function>(dlsym(RTLD_NEXT, "dmumps_c"));
   static const int failing = std::atoi(std::getenv("FAILING_FACTORIZATION"));
   static int factorizations = 0;
   if (data->job == factorize && ++factorizations == failing)
   {
      data->icntl[memory_per_rank - 1] = 1;
   }
   mumps(data);
}
