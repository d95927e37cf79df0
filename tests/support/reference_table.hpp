#pragma once

#include "mfem.hpp"

#include <map>
#include <string>
#include <vector>

namespace synovia
{

/// A reference solution: a CSV file with comment lines (#), a header of column
/// names, and numbers.
class ReferenceTable
{
public:
   /// @param file   name below tests/reference/
   explicit ReferenceTable(const std::string &file);

   int Rows() const { return static_cast<int>(rows.size()); }
   mfem::real_t Get(int row, const std::string &column) const;

   /// The value of @a column in the row whose @a key columns are nearest to
   /// those given; fails the test if they differ by more than 1e-9.
   mfem::real_t Find(const std::map<std::string, mfem::real_t> &keys,
                     const std::string &column) const;

private:
   std::map<std::string, int> columns;
   std::vector<std::vector<mfem::real_t>> rows;
};

} // namespace synovia
