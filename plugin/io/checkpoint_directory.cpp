#include "synovia/io/checkpoint_directory.hpp"
#include "synovia/general/root_rank.hpp"
#include "synovia/io/checkpoint_file.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <sstream>

namespace synovia
{

namespace
{
constexpr const char *prefix = "checkpoint_";
constexpr const char *suffix = ".h5";

struct Candidate
{
   long number;
   std::filesystem::path path;
};

/// Number of the checkpoint of this name, or -1.
long NumberOf(const std::string &name)
{
   const std::string begin(prefix);
   const std::string end(suffix);
   if (name.size() <= begin.size() + end.size() ||
       name.compare(0, begin.size(), begin) != 0 ||
       name.compare(name.size() - end.size(), end.size(), end) != 0)
   {
      return -1;
   }
   const std::string digits =
      name.substr(begin.size(), name.size() - begin.size() - end.size());
   const bool number =
      digits.find_first_not_of("0123456789") == std::string::npos &&
      digits.size() < 18;
   return number ? std::stol(digits) : -1;
}

std::string KeptName(const std::filesystem::path &directory,
                     const std::string &name)
{
   return (directory / ("step_" + name + suffix)).string();
}

/// The checkpoints there are, newest first.
std::vector<Candidate> List(const std::string &directory)
{
   std::vector<Candidate> candidates;
   std::error_code error;
   for (std::filesystem::directory_iterator entry(directory, error), end;
        !error && entry != end; entry.increment(error))
   {
      const long number = NumberOf(entry->path().filename().string());
      if (number >= 0)
      {
         candidates.push_back({number, entry->path()});
      }
   }
   std::sort(candidates.begin(), candidates.end(),
             [](const Candidate &a, const Candidate &b)
             { return a.number > b.number; });
   return candidates;
}
} // namespace

std::string CheckpointName(const std::string &directory, int steps)
{
   char digits[32];
   std::snprintf(digits, sizeof(digits), "%08d", steps);
   return directory + "/" + prefix + digits + suffix;
}

void TidyCheckpoints(const std::string &directory, int newest, int keep)
{
   std::error_code ignored;
   int kept = 0;
   for (const Candidate &candidate : List(directory))
   {
      const bool wanted = candidate.number <= newest && kept < keep;
      kept += wanted ? 1 : 0;
      if (!wanted)
      {
         std::filesystem::remove(candidate.path, ignored);
      }
   }
   std::vector<std::filesystem::path> unfinished;
   for (std::filesystem::directory_iterator entry(directory, ignored), end;
        !ignored && entry != end; entry.increment(ignored))
   {
      if (entry->path().extension() == ".new" &&
          NumberOf(entry->path().stem().string()) >= 0)
      {
         unfinished.push_back(entry->path());
      }
   }
   for (const std::filesystem::path &path : unfinished)
   {
      std::filesystem::remove(path, ignored);
   }
}

FoundCheckpoint FindCheckpoint(const std::string &directory, MPI_Comm comm)
{
   std::string lines;
   if (IsRoot(comm))
   {
      for (const Candidate &candidate : List(directory))
      {
         lines += candidate.path.string() + "\n";
      }
   }
   Broadcast(lines, comm);
   FoundCheckpoint result;
   std::istringstream stream(lines);
   for (std::string file; std::getline(stream, file);)
   {
      try
      {
         VerifyCheckpointFile(file, comm);
         result.file = file;
         break;
      }
      catch (const Error &error)
      {
         result.passed_over.push_back(error.what());
      }
   }
   return result;
}

void KeepCheckpoint(const std::string &file, const std::string &name,
                    MPI_Comm comm)
{
   OnRoot(comm,
          [&]()
          {
             const std::string kept =
                KeptName(std::filesystem::path(file).parent_path(), name);
             const std::string fresh = kept + ".new";
             std::filesystem::copy_file(
                file, fresh, std::filesystem::copy_options::overwrite_existing);
             std::filesystem::rename(fresh, kept);
          });
}

void DiscardKeptCheckpoints(const std::string &directory,
                            const std::vector<std::string> &names,
                            MPI_Comm comm)
{
   if (IsRoot(comm))
   {
      std::error_code ignored;
      for (const std::string &name : names)
      {
         std::filesystem::remove(KeptName(directory, name), ignored);
      }
   }
   MPI_Barrier(comm);
}

void DiscardCheckpointsAfter(const std::string &directory, int newest,
                             MPI_Comm comm)
{
   if (IsRoot(comm))
   {
      TidyCheckpoints(directory, newest, std::numeric_limits<int>::max());
   }
   MPI_Barrier(comm);
}

} // namespace synovia
