#pragma once

// What both interfaces of MPI count in.

#include <mpi.h>

#include <fstream>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace audit
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
inline T &NeverDestroyed()
{
   static T *const object = std::make_unique<T>().release();
   return *object;
}

inline Counter &TheCounter()
{
   return NeverDestroyed<Counter>();
}

inline long long Bytes(long long count, MPI_Datatype type)
{
   int size = 0;
   PMPI_Type_size(type, &size);
   return count * size;
}

inline long long Sum(const int *counts, MPI_Comm comm)
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

inline int Size(MPI_Comm comm)
{
   int ranks = 0;
   PMPI_Comm_size(comm, &ranks);
   return ranks;
}

} // namespace audit
