#include "synovia/io/history.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/root_rank.hpp"
#include "synovia/io/hdf5_columns.hpp"
#include "synovia/io/output_directory.hpp"
#include "synovia/io/output_file.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <limits>
#include <map>
#include <sstream>

namespace synovia
{

using namespace mfem;

namespace
{
constexpr int digits = 15;

std::vector<std::string> SplitAtCommas(const std::string &line)
{
   std::vector<std::string> parts;
   std::istringstream stream(line);
   for (std::string part; std::getline(stream, part, ',');)
   {
      parts.push_back(part);
   }
   return parts;
}

void CheckNames(const std::vector<std::string> &names)
{
   for (std::size_t i = 0; i < names.size(); i++)
   {
      if (names[i].empty() ||
          names[i].find_first_of(",\"'/\\\n\r") != std::string::npos)
      {
         throw Error("'" + names[i] +
                     "' cannot name a column of the history: it is empty or "
                     "has a comma, a quote, a slash or a line break");
      }
      if (std::find(names.begin(), names.begin() + i, names[i]) !=
          names.begin() + i)
      {
         throw Error("the history has two columns '" + names[i] + "'");
      }
   }
}
} // namespace

/// The two files, on the one rank that writes.
class History::Files
{
public:
   explicit Files(const std::string &directory)
      : csv_path(directory + "/history.csv"),
        hdf5_path(directory + "/history.h5")
   {
   }

   /// Writes the rows of the present files up to @a last anew.
   int Keep(real_t last);
   /// Removes files of an earlier run, which this one would contradict.
   void Discard();
   void Add(const Row &row);
   void AddVarying(const Row &row);

private:
   std::vector<std::vector<double>>
   ReadRows(std::vector<std::string> &old_names, real_t last) const;
   /// Writes the files anew with these rows.
   void Replace(const std::vector<std::string> &new_names,
                const std::vector<std::vector<double>> &kept);
   void Open(const std::vector<std::string> &names_, const std::string &file);
   void Write(const std::vector<std::vector<double>> &added);

   std::string csv_path;
   std::string hdf5_path;
   std::vector<std::string> names;
   std::unique_ptr<OutputFile> csv;
   std::unique_ptr<Hdf5Columns> hdf5;
};

void History::Files::Discard()
{
   std::filesystem::remove(csv_path);
   std::filesystem::remove(hdf5_path);
}

void History::Files::Open(const std::vector<std::string> &names_,
                          const std::string &file)
{
   CheckNames(names_);
   names = names_;
   std::string line;
   for (const std::string &name : names)
   {
      line += (line.empty() ? "" : ",") + name;
   }
   csv = std::make_unique<OutputFile>(file, OutputFile::Mode::truncate);
   csv->Write(line + "\n");
   hdf5 = std::make_unique<Hdf5Columns>(hdf5_path, names);
}

void History::Files::Write(const std::vector<std::vector<double>> &added)
{
   for (const std::vector<double> &values : added)
   {
      // One write of a whole line: a reader never sees half of a number.
      std::ostringstream line;
      line << std::setprecision(digits);
      for (std::size_t i = 0; i < values.size(); i++)
      {
         line << (i ? "," : "") << values[i];
      }
      csv->Write(line.str() + "\n");
   }
   hdf5->Append(added);
}

std::vector<std::vector<double>>
History::Files::ReadRows(std::vector<std::string> &old_names, real_t last) const
{
   std::ifstream old(csv_path);
   std::string line;
   if (!old || !std::getline(old, line))
   {
      throw Error("cannot read '" + csv_path + "', the history to continue");
   }
   old_names = SplitAtCommas(line);
   const auto time = std::find(old_names.begin(), old_names.end(), "t");
   if (time == old_names.end())
   {
      throw Error("'" + csv_path + "' has no column 't'");
   }
   const std::size_t t = time - old_names.begin();
   const double limit = last + 1e-12 * std::abs(last);
   std::vector<std::vector<double>> kept;
   while (std::getline(old, line))
   {
      std::vector<double> values;
      for (const std::string &part : SplitAtCommas(line))
      {
         values.push_back(std::strtod(part.c_str(), nullptr));
      }
      // The last line of a killed run may be cut short.
      if (values.size() == old_names.size() && values[t] <= limit)
      {
         kept.push_back(values);
      }
   }
   return kept;
}

void History::Files::Replace(const std::vector<std::string> &new_names,
                             const std::vector<std::vector<double>> &kept)
{
   csv.reset();
   hdf5.reset();
   // The old file is there until the new one is whole.
   const std::string fresh = csv_path + ".new";
   Open(new_names, fresh);
   Write(kept);
   std::filesystem::rename(fresh, csv_path);
}

int History::Files::Keep(real_t last)
{
   std::vector<std::string> old_names;
   const std::vector<std::vector<double>> kept = ReadRows(old_names, last);
   Replace(old_names, kept);
   return static_cast<int>(kept.size());
}

void History::Files::AddVarying(const Row &row)
{
   if (!hdf5)
   {
      Add(row);
      return;
   }
   std::map<std::string, real_t> values(row.begin(), row.end());
   Row full;
   for (const std::string &name : names)
   {
      const auto found = values.find(name);
      full.emplace_back(name, found == values.end() ? 0.0 : found->second);
   }
   for (const auto &[name, value] : row)
   {
      if (std::find(names.begin(), names.end(), name) == names.end())
      {
         full.emplace_back(name, value);
      }
   }
   if (full.size() > names.size())
   {
      std::vector<std::string> wider;
      for (const auto &[name, value] : full)
      {
         wider.push_back(name);
      }
      std::vector<std::string> old_names;
      std::vector<std::vector<double>> kept =
         ReadRows(old_names, std::numeric_limits<real_t>::max());
      for (std::vector<double> &before : kept)
      {
         before.resize(wider.size(), 0.0);
      }
      Replace(wider, kept);
   }
   Add(full);
}

void History::Files::Add(const Row &row)
{
   std::vector<std::string> these;
   std::vector<double> values;
   for (const auto &[name, value] : row)
   {
      these.push_back(name);
      values.push_back(value);
   }
   if (!hdf5)
   {
      Open(these, csv_path);
   }
   if (these != names)
   {
      const auto differs =
         std::mismatch(these.begin(), these.end(), names.begin(), names.end());
      throw Error("a row for '" + csv_path + "' has " +
                  (differs.first == these.end() ? "no more columns"
                                                : "'" + *differs.first + "'") +
                  " where the history has " +
                  (differs.second == names.end()
                      ? "no more columns"
                      : "'" + *differs.second + "'"));
   }
   Write({values});
}

History::History(const std::string &directory, MPI_Comm comm_,
                 std::optional<real_t> keep_until)
   : comm(comm_)
{
   MakeOutputDirectory(directory, comm);
   OnRoot(comm,
          [&]()
          {
             files = std::make_unique<Files>(directory);
             if (keep_until)
             {
                rows = files->Keep(*keep_until);
             }
             else
             {
                files->Discard();
             }
          });
   MPI_Bcast(&rows, 1, MPI_INT, 0, comm);
}

History::~History() = default;

void History::Add(const Row &row)
{
   OnRoot(comm, [&]() { files->Add(row); });
   rows++;
}

void History::AddVarying(const Row &row)
{
   OnRoot(comm, [&]() { files->AddVarying(row); });
   rows++;
}

} // namespace synovia
