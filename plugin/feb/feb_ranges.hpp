#pragma once

#include "synovia/feb/feb_input.hpp"

namespace synovia
{

/// The numbers in the text of an element, of which ranges FIRST:LAST or
/// FIRST:LAST:STEP stand for several; none, and the import stops, if there is
/// anything else.
std::vector<long long> ReadRanges(const FebInput &from);

} // namespace synovia
