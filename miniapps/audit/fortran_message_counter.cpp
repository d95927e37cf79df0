// The messages and collectives of Fortran programs, as MUMPS sends them: MPI's
// library for Fortran calls the inner functions of that for C.

#include "message_counts.hpp"

#include <dlfcn.h>

using namespace audit;

namespace
{
using Integer = MPI_Fint *;

long long Bytes(Integer count, Integer type)
{
   return audit::Bytes(*count, MPI_Type_f2c(*type));
}

void CountSend(Integer count, Integer type, Integer to, Integer comm)
{
   TheCounter().Send(Bytes(count, type), *to, MPI_Comm_f2c(*comm));
}

// That of the library which this one is loaded in front of.
template <typename... Arguments>
void CallNext(const char *name, Arguments... arguments)
{
   using Function = void (*)(Arguments...);
   reinterpret_cast<Function>(dlsym(RTLD_NEXT, name))(arguments...);
}
} // namespace

extern "C"
{

#define SYNOVIA_COUNT_SEND(name)                                               \
   void name(void *data, Integer count, Integer type, Integer to, Integer tag, \
             Integer comm, Integer error)                                      \
   {                                                                           \
      CountSend(count, type, to, comm);                                        \
      CallNext(#name, data, count, type, to, tag, comm, error);                \
   }
   SYNOVIA_COUNT_SEND(mpi_send_)
   SYNOVIA_COUNT_SEND(mpi_ssend_)
#undef SYNOVIA_COUNT_SEND

   void mpi_isend_(void *data, Integer count, Integer type, Integer to,
                   Integer tag, Integer comm, Integer request, Integer error)
   {
      CountSend(count, type, to, comm);
      CallNext("mpi_isend_", data, count, type, to, tag, comm, request, error);
   }

   void mpi_bcast_(void *data, Integer count, Integer type, Integer root,
                   Integer comm, Integer error)
   {
      TheCounter().Collect(Bytes(count, type));
      CallNext("mpi_bcast_", data, count, type, root, comm, error);
   }

   void mpi_reduce_(void *data, void *result, Integer count, Integer type,
                    Integer op, Integer root, Integer comm, Integer error)
   {
      TheCounter().Collect(Bytes(count, type));
      CallNext("mpi_reduce_", data, result, count, type, op, root, comm, error);
   }

   void mpi_allreduce_(void *data, void *result, Integer count, Integer type,
                       Integer op, Integer comm, Integer error)
   {
      TheCounter().Collect(Bytes(count, type));
      CallNext("mpi_allreduce_", data, result, count, type, op, comm, error);
   }

   void mpi_reduce_scatter_(void *data, void *result, Integer counts,
                            Integer type, Integer op, Integer comm,
                            Integer error)
   {
      TheCounter().Collect(
         audit::Bytes(Sum(counts, MPI_Comm_f2c(*comm)), MPI_Type_f2c(*type)));
      CallNext("mpi_reduce_scatter_", data, result, counts, type, op, comm,
               error);
   }

   void mpi_gather_(void *data, Integer count, Integer type, void *all,
                    Integer received, Integer received_type, Integer root,
                    Integer comm, Integer error)
   {
      TheCounter().Collect(Bytes(count, type));
      CallNext("mpi_gather_", data, count, type, all, received, received_type,
               root, comm, error);
   }

   void mpi_alltoall_(void *data, Integer count, Integer type, void *received,
                      Integer received_count, Integer received_type,
                      Integer comm, Integer error)
   {
      TheCounter().Collect(Bytes(received_count, received_type) *
                           Size(MPI_Comm_f2c(*comm)));
      CallNext("mpi_alltoall_", data, count, type, received, received_count,
               received_type, comm, error);
   }

} // extern "C"
