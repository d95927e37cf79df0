#pragma once

#include <string>
#include <utility>
#include <vector>

namespace synovia
{

/// Synovia's version, such as "0.1.0".
std::string Version();

/// Names and versions of Synovia and of the libraries that it uses.
std::vector<std::pair<std::string, std::string>> Versions();

/// The same in one line.
std::string VersionsText();

} // namespace synovia
