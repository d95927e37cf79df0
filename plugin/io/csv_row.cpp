#include "synovia/io/csv_row.hpp"
#include "synovia/general/error.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iomanip>

namespace synovia
{

using namespace mfem;

namespace
{
std::string Quoted(std::string text)
{
   if (text.find_first_of(",\"\n") == std::string::npos)
   {
      return text;
   }
   std::replace(text.begin(), text.end(), '"', '\'');
   std::replace(text.begin(), text.end(), '\n', ' ');
   return '"' + text + '"';
}

// The first line of a file, empty if there is none.
std::string FirstLine(const std::string &file)
{
   std::ifstream in(file);
   std::string line;
   std::getline(in, line);
   return line;
}

// Gives what went wrong, or nothing.
std::string Append(const std::string &file, const std::string &names,
                   const std::string &values)
{
   const std::string found = FirstLine(file);
   if (!found.empty() && found != names)
   {
      return "'" + file +
             "' has other columns: remove it, or name another file";
   }
   errno = 0;
   std::ofstream out(file, std::ios::app);
   // One write of whole lines: a reader never sees half of a number.
   out << (found.empty() ? names + '\n' : "") + values + '\n' << std::flush;
   return out ? "" : "cannot write '" + file + "': " + std::strerror(errno);
}
} // namespace

void CsvRow::Print(std::ostream &out) const
{
   constexpr int width = 22;
   for (const auto &[name, value] : cells)
   {
      out << std::left << std::setw(width) << name << value << '\n';
   }
   out << std::flush;
}

void CsvRow::AppendTo(const std::string &file, MPI_Comm comm) const
{
   std::string names;
   std::string values;
   for (const auto &[name, value] : cells)
   {
      names += (names.empty() ? "" : ",") + name;
      values += (&value == &cells.front().second ? "" : ",") + Quoted(value);
   }
   int rank;
   MPI_Comm_rank(comm, &rank);
   ThrowIfAny(comm, rank == 0 ? Append(file, names, values) : "");
}

} // namespace synovia
