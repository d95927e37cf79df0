#pragma once

#include "mfem.hpp"

#include <cmath>
#include <sstream>
#include <string>

namespace synovia
{

/// A number as people write it: up to six significant digits.
inline std::string ToText(mfem::real_t value)
{
   std::ostringstream text;
   text << value;
   return text.str();
}

/// An amount of memory, rounded up.
inline std::string Megabytes(double amount)
{
   return ToText(std::ceil(amount)) + " MB";
}

} // namespace synovia
