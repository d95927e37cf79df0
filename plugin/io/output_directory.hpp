#pragma once

#include <mpi.h>

#include <cstddef>
#include <string>

namespace synovia
{

/// Makes the directory @a path, and those above it, unless it is there, and
/// proves that files can be written into it. Collective; rank 0 does it. Throws
/// Error with the path and the reason if it can't be done.
void MakeOutputDirectory(const std::string &path, MPI_Comm comm);

/// Tries to write a file of @a size bytes into the directory and removes it:
/// `cannot write <subject>: <reason>`, or nothing if it can. For one process.
std::string ProbeForWriting(const std::string &directory, std::size_t size,
                            const std::string &subject);

} // namespace synovia
