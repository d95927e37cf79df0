#pragma once

#include "mfem.hpp"

#include <iosfwd>
#include <string>
#include <vector>

namespace synovia
{

/// A number for people to read: four significant digits.
std::string Quantity(mfem::real_t value);

/// Writes rows of words in columns, the first to the left, the others to the
/// right, each line indented by two.
void WriteTable(std::ostream &out,
                const std::vector<std::vector<std::string>> &rows);

} // namespace synovia
