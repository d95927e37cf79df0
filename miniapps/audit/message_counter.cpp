// Counts what each rank sends, by phases, for programs whose MPI it intercepts:
//
//   LD_PRELOAD=libsynovia_message_counter.so SYNOVIA_MESSAGE_COUNTS=counts
//
// writes counts.RANK.csv when MPI is finalized, a row for each phase that
// ProfiledPhase names, in the order in which they begin; "other" is outside of
// all. Columns: messages and bytes sent from point to point, how many ranks
// they went to, and calls of collectives that carry data, with the bytes that
// this rank contributes. Fortran programs, such as MUMPS, have an interface of
// their own (fortran_message_counter.cpp).

#include "message_counts.hpp"

#include <cstdarg>
#include <cstdlib>

using namespace audit;

namespace
{
// Persistent requests send when they are started.
struct Persistent
{
   long long bytes;
   int destination;
   MPI_Comm comm;
};
std::map<MPI_Request, Persistent> &PersistentSends()
{
   return NeverDestroyed<std::map<MPI_Request, Persistent>>();
}

void CountStart(MPI_Request request)
{
   const auto found = PersistentSends().find(request);
   if (found != PersistentSends().end())
   {
      const Persistent &send = found->second;
      TheCounter().Send(send.bytes, send.destination, send.comm);
   }
}
} // namespace

extern "C"
{

   int MPI_Pcontrol(const int level, ...)
   {
      // Of phases alone, not of the work in them.
      if (level == 1)
      {
         va_list arguments;
         va_start(arguments, level);
         TheCounter().Enter(va_arg(arguments, const char *));
         va_end(arguments);
      }
      else if (level == -1)
      {
         TheCounter().Leave();
      }
      return MPI_SUCCESS;
   }

   int MPI_Finalize()
   {
      int rank = 0;
      PMPI_Comm_rank(MPI_COMM_WORLD, &rank);
      if (const char *file = std::getenv("SYNOVIA_MESSAGE_COUNTS"))
      {
         TheCounter().Write(std::string(file) + "." + std::to_string(rank) +
                            ".csv");
      }
      return PMPI_Finalize();
   }

#define SYNOVIA_COUNT_SEND(name)                                               \
   int MPI_##name(const void *data, int count, MPI_Datatype type, int to,      \
                  int tag, MPI_Comm comm)                                      \
   {                                                                           \
      TheCounter().Send(Bytes(count, type), to, comm);                         \
      return PMPI_##name(data, count, type, to, tag, comm);                    \
   }
   SYNOVIA_COUNT_SEND(Send)
   SYNOVIA_COUNT_SEND(Ssend)
   SYNOVIA_COUNT_SEND(Rsend)
   SYNOVIA_COUNT_SEND(Bsend)
#undef SYNOVIA_COUNT_SEND

#define SYNOVIA_COUNT_SEND(name)                                               \
   int MPI_##name(const void *data, int count, MPI_Datatype type, int to,      \
                  int tag, MPI_Comm comm, MPI_Request *request)                \
   {                                                                           \
      TheCounter().Send(Bytes(count, type), to, comm);                         \
      return PMPI_##name(data, count, type, to, tag, comm, request);           \
   }
   SYNOVIA_COUNT_SEND(Isend)
   SYNOVIA_COUNT_SEND(Issend)
   SYNOVIA_COUNT_SEND(Irsend)
   SYNOVIA_COUNT_SEND(Ibsend)
#undef SYNOVIA_COUNT_SEND

   int MPI_Send_init(const void *data, int count, MPI_Datatype type, int to,
                     int tag, MPI_Comm comm, MPI_Request *request)
   {
      const int status =
         PMPI_Send_init(data, count, type, to, tag, comm, request);
      PersistentSends()[*request] = {Bytes(count, type), to, comm};
      return status;
   }

   int MPI_Start(MPI_Request *request)
   {
      CountStart(*request);
      return PMPI_Start(request);
   }

   int MPI_Startall(int count, MPI_Request requests[])
   {
      for (int i = 0; i < count; i++)
      {
         CountStart(requests[i]);
      }
      return PMPI_Startall(count, requests);
   }

   int MPI_Request_free(MPI_Request *request)
   {
      PersistentSends().erase(*request);
      return PMPI_Request_free(request);
   }

   int MPI_Sendrecv(const void *data, int count, MPI_Datatype type, int to,
                    int tag, void *received, int most,
                    MPI_Datatype received_type, int from, int received_tag,
                    MPI_Comm comm, MPI_Status *status)
   {
      TheCounter().Send(Bytes(count, type), to, comm);
      return PMPI_Sendrecv(data, count, type, to, tag, received, most,
                           received_type, from, received_tag, comm, status);
   }

   int MPI_Allreduce(const void *data, void *result, int count,
                     MPI_Datatype type, MPI_Op op, MPI_Comm comm)
   {
      TheCounter().Collect(Bytes(count, type));
      return PMPI_Allreduce(data, result, count, type, op, comm);
   }

   int MPI_Reduce(const void *data, void *result, int count, MPI_Datatype type,
                  MPI_Op op, int root, MPI_Comm comm)
   {
      TheCounter().Collect(Bytes(count, type));
      return PMPI_Reduce(data, result, count, type, op, root, comm);
   }

   int MPI_Scan(const void *data, void *result, int count, MPI_Datatype type,
                MPI_Op op, MPI_Comm comm)
   {
      TheCounter().Collect(Bytes(count, type));
      return PMPI_Scan(data, result, count, type, op, comm);
   }

   int MPI_Exscan(const void *data, void *result, int count, MPI_Datatype type,
                  MPI_Op op, MPI_Comm comm)
   {
      TheCounter().Collect(Bytes(count, type));
      return PMPI_Exscan(data, result, count, type, op, comm);
   }

   int MPI_Bcast(void *data, int count, MPI_Datatype type, int root,
                 MPI_Comm comm)
   {
      TheCounter().Collect(Bytes(count, type));
      return PMPI_Bcast(data, count, type, root, comm);
   }

   int MPI_Allgather(const void *data, int count, MPI_Datatype type, void *all,
                     int received, MPI_Datatype received_type, MPI_Comm comm)
   {
      TheCounter().Collect(Bytes(received, received_type) * Size(comm));
      return PMPI_Allgather(data, count, type, all, received, received_type,
                            comm);
   }

   int MPI_Allgatherv(const void *data, int count, MPI_Datatype type, void *all,
                      const int received[], const int offsets[],
                      MPI_Datatype received_type, MPI_Comm comm)
   {
      TheCounter().Collect(Bytes(Sum(received, comm), received_type));
      return PMPI_Allgatherv(data, count, type, all, received, offsets,
                             received_type, comm);
   }

   int MPI_Gather(const void *data, int count, MPI_Datatype type, void *all,
                  int received, MPI_Datatype received_type, int root,
                  MPI_Comm comm)
   {
      TheCounter().Collect(Bytes(count, type));
      return PMPI_Gather(data, count, type, all, received, received_type, root,
                         comm);
   }

   int MPI_Gatherv(const void *data, int count, MPI_Datatype type, void *all,
                   const int received[], const int offsets[],
                   MPI_Datatype received_type, int root, MPI_Comm comm)
   {
      TheCounter().Collect(Bytes(count, type));
      return PMPI_Gatherv(data, count, type, all, received, offsets,
                          received_type, root, comm);
   }

   int MPI_Alltoall(const void *data, int count, MPI_Datatype type,
                    void *received, int received_count,
                    MPI_Datatype received_type, MPI_Comm comm)
   {
      TheCounter().Collect(Bytes(received_count, received_type) * Size(comm));
      return PMPI_Alltoall(data, count, type, received, received_count,
                           received_type, comm);
   }

   int MPI_Alltoallv(const void *data, const int counts[], const int offsets[],
                     MPI_Datatype type, void *received,
                     const int received_counts[], const int received_offsets[],
                     MPI_Datatype received_type, MPI_Comm comm)
   {
      TheCounter().Collect(Bytes(Sum(counts, comm), type));
      return PMPI_Alltoallv(data, counts, offsets, type, received,
                            received_counts, received_offsets, received_type,
                            comm);
   }

} // extern "C"
