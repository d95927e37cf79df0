#include "synovia/io/run_log.hpp"
#include "synovia/general/root_rank.hpp"
#include "synovia/general/utc_time.hpp"
#include "synovia/io/output_file.hpp"

#include <sstream>

namespace synovia
{

namespace
{
std::string InOneLine(const std::string &text)
{
   std::istringstream lines(text);
   std::string joined;
   for (std::string line; std::getline(lines, line);)
   {
      line.erase(0, line.find_first_not_of(' '));
      joined += (joined.empty() ? "" : "; ") + line;
   }
   return joined;
}
} // namespace

RunLog::RunLog(const std::string &directory, MPI_Comm comm_, bool append)
   : comm(comm_)
{
   OnRoot(comm,
          [&]()
          {
             file = std::make_unique<OutputFile>(
                directory + "/run.log",
                append ? OutputFile::Mode::append : OutputFile::Mode::truncate);
          });
}

RunLog::~RunLog() = default;

void RunLog::Write(const std::string &text)
{
   file->Write(UtcNow() + "  " + InOneLine(text) + "\n");
}

void RunLog::Add(const std::string &text)
{
   OnRoot(comm, [&]() { Write(text); });
}

void RunLog::TryToAdd(const std::string &text) noexcept
{
   try
   {
      if (file)
      {
         Write(text);
      }
   }
   catch (const std::exception &)
   {
   }
}

} // namespace synovia
