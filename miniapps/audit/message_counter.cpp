// Counts what each rank sends, by phases, for programs whose MPI it intercepts:
//
//   LD_PRELOAD=libsynovia_message_counter.so SYNOVIA_MESSAGE_COUNTS=counts
//
// writes counts.RANK.csv when MPI is finalized, a row for each phase that
// ProfiledPhase names, in the order in which they begin; "other" is outside of
// all. Columns: messages and bytes sent from point to point, how many ranks
// they went to, and calls of collectives that carry data, with the bytes that
// this rank contributes. Messages of Fortran programs, such as MUMPS, are not
// seen: their library calls MPI's inner functions.

#include <mpi.h>

#include <cstdarg>
#include <cstdlib>
#include <fstream>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace
{
struct Counts
{
   long long messages = 0;
   long long bytes = 0;
   std::set<int> destinations;
   long long collectives = 0;
   long long collective_bytes = 0;
};

class Counter
{
public:
   void Enter(const std::string &phase) { open.push_back(&Of(phase)); }
   void Leave()
   {
      if (!open.empty())
      {
         open.pop_back();
      }
   }
   void Send(long long bytes, int destination, MPI_Comm comm)
   {
      if (destination == MPI_PROC_NULL)
      {
         return;
      }
      Counts &counts = Current();
      counts.messages++;
      counts.bytes += bytes;
      counts.destinations.insert(WorldRank(destination, comm));
   }
   void Collect(long long bytes)
   {
      Counts &counts = Current();
      counts.collectives++;
      counts.collective_bytes += bytes;
   }
   void Write(const std::string &file) const
   {
      std::ofstream out(file);
      out << "phase,messages,bytes,destinations,collectives,collective_bytes\n";
      for (const std::string &phase : order)
      {
         const Counts &counts = phases.at(phase);
         out << phase << ',' << counts.messages << ',' << counts.bytes << ','
             << counts.destinations.size() << ',' << counts.collectives << ','
             << counts.collective_bytes << '\n';
      }
   }

private:
   Counts &Of(const std::string &phase)
   {
      const auto [entry, fresh] = phases.try_emplace(phase);
      if (fresh)
      {
         order.push_back(phase);
      }
      return entry->second;
   }
   Counts &Current() { return open.empty() ? Of("other") : *open.back(); }
   static int WorldRank(int rank, MPI_Comm comm)
   {
      MPI_Group group = MPI_GROUP_NULL;
      MPI_Group world = MPI_GROUP_NULL;
      PMPI_Comm_group(comm, &group);
      PMPI_Comm_group(MPI_COMM_WORLD, &world);
      int in_world = rank;
      PMPI_Group_translate_ranks(group, 1, &rank, world, &in_world);
      PMPI_Group_free(&group);
      PMPI_Group_free(&world);
      return in_world;
   }

   std::map<std::string, Counts> phases;
   std::vector<std::string> order;
   std::vector<Counts *> open;
};

// MPI may be finalized by the destructor of a static object, after those of
// this library: what it counts in is never destroyed.
template <typename T>
T &NeverDestroyed()
{
   static T *const object = std::make_unique<T>().release();
   return *object;
}

Counter &TheCounter()
{
   return NeverDestroyed<Counter>();
}

long long Bytes(long long count, MPI_Datatype type)
{
   int size = 0;
   PMPI_Type_size(type, &size);
   return count * size;
}

long long Sum(const int *counts, MPI_Comm comm)
{
   int ranks = 0;
   PMPI_Comm_size(comm, &ranks);
   long long sum = 0;
   for (int i = 0; i < ranks; i++)
   {
      sum += counts[i];
   }
   return sum;
}

int Size(MPI_Comm comm)
{
   int ranks = 0;
   PMPI_Comm_size(comm, &ranks);
   return ranks;
}

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
