#pragma once

#include <mpi.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

namespace synovia
{

/// An empty directory, the same on all ranks, that goes with the object.
/// Collective.
class TempDirectory
{
public:
   TempDirectory()
   {
      const std::string base =
         std::filesystem::temp_directory_path() / "synovia-test-XXXXXX";
      path = base;
      MPI_Comm_rank(MPI_COMM_WORLD, &rank);
      if (rank == 0 && !mkdtemp(path.data()))
      {
         throw std::runtime_error("cannot make a temporary directory");
      }
      MPI_Bcast(path.data(), static_cast<int>(path.size()), MPI_CHAR, 0,
                MPI_COMM_WORLD);
   }
   ~TempDirectory()
   {
      MPI_Barrier(MPI_COMM_WORLD);
      if (rank == 0)
      {
         std::error_code ignored;
         std::filesystem::remove_all(path, ignored);
      }
   }
   TempDirectory(const TempDirectory &) = delete;
   TempDirectory &operator=(const TempDirectory &) = delete;

   std::string operator/(const std::string &name) const
   {
      return path + "/" + name;
   }
   const std::string &Path() const { return path; }

   /// Does @a work on rank 0 while the others wait for it.
   template <typename Work>
   void OnRootOnly(Work work) const
   {
      MPI_Barrier(MPI_COMM_WORLD);
      if (rank == 0)
      {
         work();
      }
      MPI_Barrier(MPI_COMM_WORLD);
   }

private:
   std::string path;
   int rank = 0;
};

/// The whole of a file, or nothing if it can't be read.
inline std::string ReadText(const std::string &path)
{
   std::ifstream file(path, std::ios::binary);
   std::ostringstream text;
   text << file.rdbuf();
   return text.str();
}

} // namespace synovia
