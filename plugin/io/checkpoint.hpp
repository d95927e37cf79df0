#pragma once

#include "solvers/time_stepper.hpp"

#include <string>
#include <vector>

namespace synovia
{

/// Writes everything that a run needs to go on from where it is into @a
/// directory, which is made where needed, and returns the name of the file,
/// `checkpoint_<steps>.h5`.
///
/// It is an HDF5 file that is there as a whole or not at all, and checked when
/// it is read. It holds the same on any number of ranks, and can be read on any
/// other. The newest @a keep checkpoints stay; the others go, and so do those
/// of later steps, which an earlier run must have left.
///
/// Collective; rank 0 writes. Throws Error on all ranks if the file can't be
/// written, because the disk is full, say: those of before are then still
/// there, and the caller may go on.
std::string WriteCheckpoint(const std::string &directory,
                            BiphasicProblem &problem, TimeStepper &stepper,
                            int keep = 2);

/// Sets @a problem and @a stepper to what they were when the file was written.
///
/// They must have been made like those: same mesh, order, materials and contact
/// pairs. The options of the stepper may differ (end, step, scheme), and the
/// number of ranks may.
///
/// Collective; rank 0 reads. Throws Error on all ranks, before anything is
/// changed, if the file can't be read, is damaged or no checkpoint, or is one
/// of another problem.
void ReadCheckpoint(const std::string &file, BiphasicProblem &problem,
                    TimeStepper &stepper);

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

/// Removes the checkpoints in @a directory, which a run from the start would
/// contradict. Collective.
void DiscardCheckpoints(const std::string &directory, MPI_Comm comm);

} // namespace synovia
