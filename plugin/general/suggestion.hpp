#pragma once

#include <string>
#include <vector>

namespace synovia
{

/// The candidate that @a name is most likely a slip of the keyboard for: one
/// or two letters changed, missing, added or swapped, or another case. Empty
/// if none is near.
std::string Suggest(const std::string &name,
                    const std::vector<std::string> &candidates);

} // namespace synovia
