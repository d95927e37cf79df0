#include "support/temporary_directory.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace synovia
{

namespace
{

bool IsRoot(MPI_Comm comm)
{
   int rank = 0;
   MPI_Comm_rank(comm, &rank);
   return rank == 0;
}

} // namespace

TemporaryDirectory::TemporaryDirectory(MPI_Comm comm_) : comm(comm_)
{
   const auto directory = std::filesystem::temp_directory_path();
   path = (directory / "synovia-XXXXXX").string();
   int made = 1;
   if (IsRoot(comm))
   {
      made = mkdtemp(path.data()) != nullptr;
   }
   MPI_Bcast(&made, 1, MPI_INT, 0, comm);
   MPI_Bcast(path.data(), static_cast<int>(path.size()), MPI_CHAR, 0, comm);
   if (!made)
   {
      throw std::runtime_error("cannot make the directory " + path);
   }
}

TemporaryDirectory::~TemporaryDirectory()
{
   MPI_Barrier(comm);
   if (IsRoot(comm))
   {
      std::error_code ignored;
      std::filesystem::remove_all(path, ignored);
   }
}

std::string TemporaryDirectory::Write(const std::string &name,
                                      const std::string &text) const
{
   const std::string file = *this / name;
   OnRootOnly([&]() { std::ofstream(file, std::ios::binary) << text; });
   return file;
}

std::string ReadText(const std::string &path)
{
   std::ifstream file(path, std::ios::binary);
   std::ostringstream text;
   text << file.rdbuf();
   return text.str();
}

} // namespace synovia
