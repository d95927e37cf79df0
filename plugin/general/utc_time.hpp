#pragma once

#include <string>

namespace synovia
{

/// Date and time now, such as 2014-08-01T12:00:00Z.
std::string UtcNow();

} // namespace synovia
