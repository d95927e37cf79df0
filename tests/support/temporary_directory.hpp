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

   std::string File(const std::string &name) const { return path + "/" + name; }

   /// Collective: rank 0 writes a file, which is there on return. Returns its
   /// path.
   std::string Write(const std::string &name, const std::string &text) const;

   MPI_Comm GetComm() const { return comm; }

private:
   MPI_Comm comm;
   std::string path;
};

} // namespace synovia
