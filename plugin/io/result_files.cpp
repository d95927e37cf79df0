#include "synovia/io/result_files.hpp"
#include "synovia/io/output_file.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <stdexcept>
#include <vector>

namespace synovia
{

using mfem::real_t;

namespace
{
namespace fs = std::filesystem;

// Paths of files within the output directory.
const std::regex history_name(R"(history\.(csv|h5)(\.new)?)");
const std::regex line_name(R"(lines/.+_t([-+.e0-9]+)\.csv(\.new)?)");
const std::regex log_name(R"(logs/[^/]+)");
const std::regex series_name(R"(fields/([^/]+)/\1\.pvd(\.new)?)");
const std::regex
   fields_name(R"(fields/[^/]+/Cycle([0-9]+)/(data\.pvtu|proc[0-9]+\.vtu))");
const std::regex
   checkpoint_name(R"(checkpoint/(checkpoint_[0-9]+|step_[^/]+)\.h5(\.new)?)");
const std::regex about_name(R"(run\.log|case\.toml(\.new)?|report\.html)");
constexpr const char *report_name = "report.html";
const char *const folders[] = {"lines", "logs", "fields", "checkpoint"};

struct Found
{
   fs::path path;
   /// Relative to the output directory, with slashes.
   std::string name;

   bool Is(const std::regex &pattern) const
   {
      return std::regex_match(name, pattern);
   }
   bool IsResult() const
   {
      return Is(history_name) || Is(line_name) || Is(log_name) ||
             Is(series_name) || Is(fields_name) || Is(checkpoint_name);
   }
   /// What the first group of the pattern matches; empty if the name does not.
   std::string Part(const std::regex &pattern) const
   {
      std::smatch match;
      return std::regex_match(name, match, pattern) ? match[1].str() : "";
   }
};

/// All files and directories that could be of a run, in order.
std::vector<Found> Find(const fs::path &directory)
{
   std::vector<Found> found;
   std::error_code error;
   const auto add = [&](const fs::path &path)
   {
      found.push_back(
         {path, path.lexically_relative(directory).generic_string()});
   };
   for (fs::directory_iterator entry(directory, error), end;
        !error && entry != end; entry.increment(error))
   {
      add(entry->path());
   }
   for (const char *folder : folders)
   {
      for (fs::recursive_directory_iterator entry(directory / folder, error),
           end;
           !error && entry != end; entry.increment(error))
      {
         add(entry->path());
      }
   }
   std::sort(found.begin(), found.end(),
             [](const Found &a, const Found &b) { return a.name < b.name; });
   return found;
}

void Remove(const fs::path &path)
{
   std::error_code error;
   fs::remove(path, error);
   if (error)
   {
      throw std::runtime_error("cannot remove '" + path.string() +
                               "': " + error.message());
   }
}

/// Removes the directories below the folders that are empty, and these.
void RemoveEmptyFolders(const fs::path &directory)
{
   std::vector<Found> found = Find(directory);
   // Files come after their directory.
   std::reverse(found.begin(), found.end());
   for (const Found &item : found)
   {
      const bool ours =
         std::any_of(std::begin(folders), std::end(folders),
                     [&](const std::string &folder)
                     { return (item.name + "/").rfind(folder + "/", 0) == 0; });
      std::error_code error;
      if (ours && fs::is_directory(item.path, error) &&
          fs::is_empty(item.path, error) && !error)
      {
         Remove(item.path);
      }
   }
}

/// Leaves out the steps that come later from a file of ParaView that names
/// those of a time series, a line each.
void ShortenSeries(const fs::path &path, int steps)
{
   const std::regex entry(R"re(<DataSet .*file="Cycle([0-9]+)/.*)re");
   std::ifstream file(path);
   std::string kept;
   bool shorter = false;
   for (std::string line; std::getline(file, line);)
   {
      std::smatch match;
      const bool later = std::regex_search(line, match, entry) &&
                         std::strtol(match[1].str().c_str(), nullptr, 10) >
                            static_cast<long>(steps);
      shorter = shorter || later;
      kept += later ? "" : line + "\n";
   }
   if (shorter)
   {
      ReplaceFile(path.string(), kept);
   }
}
} // namespace

std::string ListResults(const std::string &directory)
{
   std::string list;
   std::map<std::string, int> counts;
   for (const Found &item : Find(directory))
   {
      const std::size_t slash = item.name.find('/');
      if (!item.IsResult())
      {
         continue;
      }
      if (slash != std::string::npos)
      {
         counts[item.name.substr(0, slash)]++;
      }
      else
      {
         list += (list.empty() ? "" : ", ") + item.name;
      }
   }
   for (const auto &[folder, count] : counts)
   {
      list += (list.empty() ? "" : ", ") + folder + "/ (" +
              std::to_string(count) + (count == 1 ? " file)" : " files)");
   }
   return list;
}

void RemoveResults(const std::string &directory)
{
   for (const Found &item : Find(directory))
   {
      if (item.IsResult() || item.Is(about_name))
      {
         Remove(item.path);
      }
   }
   RemoveEmptyFolders(directory);
}

void RemoveResultsAfter(const std::string &directory, real_t time, int steps)
{
   // Names of lines have ten digits of their times.
   const real_t limit = time + 1e-9 * std::abs(time);
   for (const Found &item : Find(directory))
   {
      const std::string line_time = item.Part(line_name);
      const std::string cycle = item.Part(fields_name);
      if ((!line_time.empty() &&
           std::strtod(line_time.c_str(), nullptr) > limit) ||
          (!cycle.empty() && std::strtol(cycle.c_str(), nullptr, 10) >
                                static_cast<long>(steps)) ||
          item.name == report_name)
      {
         Remove(item.path);
      }
      else if (item.Is(series_name))
      {
         ShortenSeries(item.path, steps);
      }
   }
   RemoveEmptyFolders(directory);
}

} // namespace synovia
