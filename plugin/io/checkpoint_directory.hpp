#pragma once

#include <mpi.h>

#include <string>
#include <vector>

namespace synovia
{

/// The file of the checkpoint after so many steps.
std::string CheckpointName(const std::string &directory, int steps);

/// Removes those after more than @a newest steps, all others but the newest
/// @a keep, and what a killed run left unfinished. For one process.
void TidyCheckpoints(const std::string &directory, int newest, int keep);

struct FoundCheckpoint
{
   /// Empty if there is none.
   std::string file;
   /// Newer ones that can't be used, each with the reason.
   std::vector<std::string> passed_over;
};
/// The newest checkpoint in @a directory that is not damaged. Collective; rank
/// 0 reads.
FoundCheckpoint FindCheckpoint(const std::string &directory, MPI_Comm comm);

/// Keeps a copy of a checkpoint beside it, as `step_<name>.h5`, which no later
/// one displaces. Collective; rank 0 writes. Throws Error if it can't.
void KeepCheckpoint(const std::string &file, const std::string &name,
                    MPI_Comm comm);

/// Removes the copies of these names, if there are any. Collective.
void DiscardKeptCheckpoints(const std::string &directory,
                            const std::vector<std::string> &names,
                            MPI_Comm comm);

/// Removes the checkpoints in @a directory after more than @a newest steps,
/// which a run that goes on from there would contradict; all of them for -1.
/// Collective.
void DiscardCheckpointsAfter(const std::string &directory, int newest,
                             MPI_Comm comm);

} // namespace synovia
