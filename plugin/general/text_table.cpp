#include "synovia/general/text_table.hpp"

#include <algorithm>
#include <iomanip>
#include <ostream>
#include <sstream>

namespace synovia
{

std::string Quantity(mfem::real_t value)
{
   std::ostringstream text;
   text << std::setprecision(4) << value;
   return text.str();
}

void WriteTable(std::ostream &out,
                const std::vector<std::vector<std::string>> &rows)
{
   std::vector<size_t> widths;
   for (const std::vector<std::string> &row : rows)
   {
      widths.resize(std::max(widths.size(), row.size()));
      for (size_t i = 0; i < row.size(); i++)
      {
         widths[i] = std::max(widths[i], row[i].size());
      }
   }
   for (const std::vector<std::string> &row : rows)
   {
      out << ' ';
      for (size_t i = 0; i < row.size(); i++)
      {
         out << ' ' << (i == 0 ? std::left : std::right)
             << std::setw(static_cast<int>(widths[i]) + (i == 0 ? 0 : 1))
             << row[i];
      }
      out << std::right << '\n';
   }
}

} // namespace synovia
