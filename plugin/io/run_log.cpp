#include "io/run_log.hpp"
#include "general/error.hpp"

#include <cerrno>
#include <cstring>
#include <ctime>

namespace synovia
{

namespace
{
std::string Now()
{
   const std::time_t now = std::time(nullptr);
   std::tm parts;
   gmtime_r(&now, &parts);
   char text[32];
   std::strftime(text, sizeof(text), "%Y-%m-%dT%H:%M:%SZ", &parts);
   return text;
}
} // namespace

RunLog::RunLog(const std::string &directory, MPI_Comm comm_, bool append)
   : comm(comm_), path(directory + "/run.log")
{
   MPI_Comm_rank(comm, &rank);
   std::string problem;
   if (rank == 0)
   {
      errno = 0;
      file.open(path, append ? std::ios::app : std::ios::trunc);
      if (!file)
      {
         problem = "cannot write '" + path + "': " + std::strerror(errno);
      }
   }
   ThrowIfAny(comm, problem);
}

std::string RunLog::Write(const std::string &text)
{
   if (rank != 0)
   {
      return "";
   }
   errno = 0;
   file << Now() + "  " + text + "\n" << std::flush;
   return file ? "" : "cannot write '" + path + "': " + std::strerror(errno);
}

void RunLog::Add(const std::string &text)
{
   ThrowIfAny(comm, Write(text));
}

void RunLog::TryToAdd(const std::string &text) noexcept
{
   try
   {
      Write(text);
   }
   catch (const std::exception &)
   {
   }
}

} // namespace synovia
