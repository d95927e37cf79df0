#pragma once

#include "mfem.hpp"

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

} // namespace synovia
