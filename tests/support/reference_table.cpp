#include "support/reference_table.hpp"

#include <cmath>
#include <fstream>
#include <sstream>

namespace synovia
{

using namespace mfem;

ReferenceTable::ReferenceTable(const std::string &file)
{
   const std::string path =
      std::string(SYNOVIA_SOURCE_DIR) + "/tests/reference/" + file;
   std::ifstream in(path);
   MFEM_VERIFY(in, "no reference table " << path);
   std::string line;
   while (std::getline(in, line))
   {
      if (line.empty() || line[0] == '#')
      {
         continue;
      }
      std::istringstream cells(line);
      std::string cell;
      if (columns.empty())
      {
         for (int i = 0; std::getline(cells, cell, ','); i++)
         {
            columns[cell] = i;
         }
         continue;
      }
      rows.emplace_back();
      while (std::getline(cells, cell, ','))
      {
         rows.back().push_back(std::stod(cell));
      }
      MFEM_VERIFY(rows.back().size() == columns.size(),
                  path << ": a row has another number of columns");
   }
   MFEM_VERIFY(!rows.empty(), path << " has no rows");
}

real_t ReferenceTable::Get(int row, const std::string &column) const
{
   return rows.at(row).at(columns.at(column));
}

real_t ReferenceTable::Find(const std::map<std::string, real_t> &keys,
                            const std::string &column) const
{
   for (int i = 0; i < Rows(); i++)
   {
      bool match = true;
      for (const auto &[key, value] : keys)
      {
         match = match && std::abs(Get(i, key) - value) < 1e-9;
      }
      if (match)
      {
         return Get(i, column);
      }
   }
   MFEM_ABORT("the reference table has no such row");
   return 0.0;
}

} // namespace synovia
