#pragma once

#include <mpi.h>

#include <string>

namespace synovia
{

/// Makes the directory @a path, and those above it, unless it is there, and
/// proves that files can be written into it. Collective; rank 0 does it. Throws
/// Error with the path and the reason if it can't be done.
void MakeOutputDirectory(const std::string &path, MPI_Comm comm);

} // namespace synovia
