#pragma once

#include <mpi.h>

#include <string>

namespace synovia
{

/// What to type into a shell, in any directory, to go on with the run of this
/// output directory on as many ranks: its case.toml has all that was set on the
/// command line or by a program. Collective.
std::string ResumeCommand(const std::string &output_directory, MPI_Comm comm);

} // namespace synovia
