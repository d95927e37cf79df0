#include "synovia/io/output_directory.hpp"
#include "synovia/general/root_rank.hpp"
#include "synovia/io/output_file.hpp"

#include <filesystem>
#include <stdexcept>

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
   return ProbeForWriting(path, 1, "into the output directory '" + path + "'");
}
} // namespace

std::string ProbeForWriting(const std::string &directory, std::size_t size,
                            const std::string &subject)
{
   const std::string probe = directory + "/.synovia-write-test";
   std::string reason;
   try
   {
      OutputFile file(probe, OutputFile::Mode::truncate, subject);
      file.Write(std::string(size, ' '));
      file.Close();
   }
   catch (const std::runtime_error &error)
   {
      reason = error.what();
   }
   std::error_code ignored;
   std::filesystem::remove(probe, ignored);
   return reason;
}

void MakeOutputDirectory(const std::string &path, MPI_Comm comm)
{
   ThrowIfAny(comm, IsRoot(comm) ? TryToMake(path) : std::string());
}

} // namespace synovia
