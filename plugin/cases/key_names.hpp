#pragma once

#include <string>
#include <vector>

namespace synovia
{

/// The path of a key in the table at @a path, which is empty at the top.
std::string Joined(const std::string &path, const std::string &key);

/// The path of an entry of a list, or of a key in it.
std::string EntryPath(const std::string &list, std::size_t i,
                      const std::string &key = "");

/// With commas between them.
std::string JoinedNames(const std::vector<std::string> &names);

/// "; did you mean ...?", if a name that is known is like this one.
std::string DidYouMean(const std::string &name,
                       const std::vector<std::string> &known);

/// Quantities of keys.
namespace quantities
{
constexpr const char *length = "length";
constexpr const char *stress = "stress";
constexpr const char *time = "time";
} // namespace quantities

} // namespace synovia
