#pragma once

#include <mpi.h>

#include <string>

namespace synovia
{

/// Has a directory for one run as long as it lives, and no longer than the
/// process does, even if that is killed: the system then lets go of it.
class DirectoryLock
{
public:
   /// Locks a directory that files can be written into. Collective; rank 0 has
   /// the lock. Throws Error on all ranks if another one lives, in this process
   /// or in another, and says in which, on what host, and since when.
   DirectoryLock(const std::string &directory, MPI_Comm comm);
   ~DirectoryLock();
   DirectoryLock(const DirectoryLock &) = delete;
   DirectoryLock &operator=(const DirectoryLock &) = delete;

   /// Why two runs could get into the directory after all: file systems may
   /// have no locks. Empty if there is one. The same on all ranks.
   const std::string &Doubt() const { return doubt; }

private:
   void Take(const std::string &directory);

   std::string path;
   std::string doubt;
   int descriptor = -1; // rank 0 only
};

} // namespace synovia
