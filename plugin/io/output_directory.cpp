#include "io/output_directory.hpp"
#include "general/error.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

namespace synovia
{

namespace
{
std::string TryToMake(const std::string &path)
{
   std::error_code error;
   std::filesystem::create_directories(path, error);
   if (error && !std::filesystem::is_directory(path))
   {
      return "cannot make the output directory '" + path +
             "': " + error.message();
   }
   // Permissions tell little: the file system may be read-only or full.
   const std::string probe = path + "/.synovia-write-test";
   errno = 0;
   std::FILE *file = std::fopen(probe.c_str(), "w");
   const bool written = file && std::fputs("probe", file) >= 0;
   const bool closed = file && std::fclose(file) == 0;
   const int reason = errno;
   std::filesystem::remove(probe, error);
   if (!written || !closed)
   {
      return "cannot write into the output directory '" + path +
             "': " + std::strerror(reason);
   }
   return "";
}
} // namespace

void MakeOutputDirectory(const std::string &path, MPI_Comm comm)
{
   int rank = 0;
   MPI_Comm_rank(comm, &rank);
   ThrowIfAny(comm, rank == 0 ? TryToMake(path) : std::string());
}

} // namespace synovia
