#pragma once

#include <cstddef>
#include <map>
#include <string>

namespace synovia
{

/// What a checkpoint holds, by names without slashes.
struct CheckpointContents
{
   std::map<std::string, std::string> texts;
   std::map<std::string, double> numbers;
   /// How many values each field has; they stay where they are.
   std::map<std::string, std::size_t> field_sizes;
};

} // namespace synovia
