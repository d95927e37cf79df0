#pragma once

#include "mfem.hpp"

#include <iosfwd>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace synovia
{

/// Named values in order: one row of a table in a file, to which other runs add
/// theirs.
class CsvRow
{
public:
   /// Numbers are written with ten significant digits.
   template <typename Value>
   void Add(const std::string &name, const Value &value)
   {
      std::ostringstream text;
      text.precision(10);
      text << value;
      cells.emplace_back(name, text.str());
   }

   /// One line for each value.
   void Print(std::ostream &out) const;

   /// Appends the row to a file, which gets a line of names first if it is not
   /// there or empty. Collective; rank 0 writes. Throws Error on all ranks if
   /// the file can't be written or has other columns.
   void AppendTo(const std::string &file, MPI_Comm comm) const;

private:
   std::vector<std::pair<std::string, std::string>> cells;
};

} // namespace synovia
