#pragma once

#include "mfem.hpp"

namespace synovia
{

/// Lets MFEM's parser read the command line. False if --help was asked for,
/// which rank 0 then prints. Throws Error, on all ranks, if an option is
/// unknown or has a value that it can't have.
bool ParseCommandLine(mfem::OptionsParser &args);

} // namespace synovia
