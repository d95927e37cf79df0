#pragma once

#include <cstdint>
#include <string>

namespace synovia::checkpoint_head
{

// HDF5 leaves the first 512 bytes, the user block, to us: they tell what the
// rest must be.
constexpr std::size_t size = 512;
constexpr const char *magic = "synovia checkpoint 2";

/// The first bytes of a file of @a bytes more, of this PositionalSum.
std::string Text(std::size_t bytes, std::uint64_t sum);

} // namespace synovia::checkpoint_head
