#include "synovia/io/log_tables.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/root_rank.hpp"
#include "synovia/io/output_directory.hpp"
#include "synovia/io/output_file.hpp"

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

namespace synovia
{

using namespace mfem;

namespace
{
constexpr int digits_of_values = 9;
constexpr int digits_of_times = 15;
constexpr const char *step_head = "*Step  = ";
constexpr const char *time_head = "*Time  = ";

std::unique_ptr<LogRows> MakeRows(const LogDefinition &log,
                                  BiphasicProblem &problem)
{
   if (log.of == LogSubject::rigid_bodies)
   {
      return MakeRigidBodyRows(log, problem);
   }
   if (!problem.Mesh().Numbers().known)
   {
      throw Error("the log \"" + log.file +
                  "\": nodes and elements have numbers only where a mesh file "
                  "gives them");
   }
   return log.of == LogSubject::nodes ? MakeNodeRows(log, problem)
                                      : MakeElementRows(log, problem);
}

// All ranks' values, on rank 0.
std::vector<real_t> GatherOnRoot(const std::vector<real_t> &values,
                                 MPI_Comm comm)
{
   int ranks = 1;
   MPI_Comm_size(comm, &ranks);
   const int mine = static_cast<int>(values.size());
   std::vector<int> counts(ranks);
   MPI_Gather(&mine, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, comm);
   std::vector<int> begins(ranks + 1, 0);
   for (int i = 0; i < ranks; i++)
   {
      begins[i + 1] = begins[i] + counts[i];
   }
   std::vector<real_t> all(IsRoot(comm) ? begins[ranks] : 0);
   MPI_Gatherv(values.data(), mine, MPITypeMap<real_t>::mpi_type, all.data(),
               counts.data(), begins.data(), MPITypeMap<real_t>::mpi_type, 0,
               comm);
   return all;
}

// What a file has of times up to that one.
std::string BlocksUntil(const std::string &path, real_t last)
{
   const real_t limit = last + 1e-12 * std::abs(last);
   std::ifstream file(path);
   std::string kept;
   std::string block;
   bool in_time = true;
   for (std::string line; std::getline(file, line);)
   {
      if (line.rfind(step_head, 0) == 0)
      {
         kept += in_time ? block : "";
         block.clear();
         in_time = true;
      }
      else if (line.rfind(time_head, 0) == 0)
      {
         in_time = std::strtod(line.c_str() + std::string(time_head).size(),
                               nullptr) <= limit;
      }
      block += line + "\n";
   }
   return kept + (in_time ? block : "");
}
} // namespace

struct LogTables::Table
{
   LogDefinition log;
   std::unique_ptr<LogRows> rows;
   /// On rank 0.
   std::unique_ptr<OutputFile> file;

   void Open(const std::string &path, std::optional<real_t> last)
   {
      const std::string kept = last ? BlocksUntil(path, *last) : "";
      ReplaceFile(path, kept);
      file = std::make_unique<OutputFile>(path, OutputFile::Mode::append);
   }

   void Write(int step, real_t time, const std::vector<real_t> &values)
   {
      const size_t width = log.data.size() + 1;
      // Ranks share nodes.
      std::map<long long, const real_t *> by_number;
      for (size_t i = 0; i + width <= values.size(); i += width)
      {
         by_number[std::llround(values[i])] = &values[i + 1];
      }
      std::ostringstream text;
      text.precision(digits_of_times);
      text << step_head << step << '\n' << time_head << time << "\n*Data  = ";
      for (size_t i = 0; i < log.data.size(); i++)
      {
         text << (i ? ";" : "") << log.data[i];
      }
      text << '\n';
      text.precision(digits_of_values);
      for (const auto &[number, row] : by_number)
      {
         text << number;
         for (size_t i = 0; i < log.data.size(); i++)
         {
            text << log.delimiter << row[i];
         }
         text << '\n';
      }
      file->Write(text.str());
   }
};

LogTables::LogTables(const std::vector<LogDefinition> &logs,
                     BiphasicProblem &problem)
   : comm(problem.Mesh().GetComm())
{
   for (const LogDefinition &log : logs)
   {
      tables.push_back(std::make_unique<Table>());
      tables.back()->log = log;
      tables.back()->rows = MakeRows(tables.back()->log, problem);
   }
}

LogTables::~LogTables() = default;

void LogTables::Open(const std::string &directory, std::optional<real_t> last)
{
   if (tables.empty())
   {
      return;
   }
   MakeOutputDirectory(directory + "/logs", comm);
   OnRoot(comm,
          [&]()
          {
             for (const auto &table : tables)
             {
                table->Open(directory + "/logs/" + table->log.file, last);
             }
          });
}

void LogTables::Write(TimeStepper &stepper)
{
   for (const auto &table : tables)
   {
      const std::vector<real_t> values =
         GatherOnRoot(table->rows->Collect(stepper), comm);
      OnRoot(comm,
             [&]() { table->Write(stepper.Steps(), stepper.Time(), values); });
   }
}

} // namespace synovia
