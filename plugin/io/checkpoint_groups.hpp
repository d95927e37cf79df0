#pragma once

namespace synovia::checkpoint_groups
{

// Groups of a checkpoint's HDF5 file.
constexpr const char *texts = "texts";
constexpr const char *numbers = "numbers";
constexpr const char *fields = "fields";

} // namespace synovia::checkpoint_groups
