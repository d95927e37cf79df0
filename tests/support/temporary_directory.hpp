#pragma once

#include <mpi.h>

#include <string>

namespace synovia
{

/// A directory that all ranks see, empty at first and gone with its contents at
/// the end. Collective at both.
class TemporaryDirectory
{
public:
   explicit TemporaryDirectory(MPI_Comm comm = MPI_COMM_WORLD);
   ~TemporaryDirectory();
   TemporaryDirectory(const TemporaryDirectory &) = delete;
   TemporaryDirectory &operator=(const TemporaryDirectory &) = delete;

   const std::string &Path() const { return path; }
   std::string operator/(const std::string &name) const
   {
      return path + "/" + name;
   }

   /// Collective: rank 0 writes a file, which is there on return. Returns its
   /// path.
   std::string Write(const std::string &name, const std::string &text) const;

   /// Collective: does @a work on rank 0 while the others wait for it.
   template <typename Work>
   void OnRootOnly(Work work) const
   {
      MPI_Barrier(comm);
      int rank = 0;
      MPI_Comm_rank(comm, &rank);
      if (rank == 0)
      {
         work();
      }
      MPI_Barrier(comm);
   }

   MPI_Comm GetComm() const { return comm; }

private:
   MPI_Comm comm;
   std::string path;
};

/// The whole of a file, or nothing if it can't be read.
std::string ReadText(const std::string &path);

} // namespace synovia
