#pragma once

#include "synovia/io/checkpoint_contents.hpp"
#include "synovia/time/time_stepper.hpp"

#include <string>

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
/// @a setup is the case as text, to be compared when a run goes on from it.
///
/// Collective; each rank writes a part of each field, so that all must see the
/// directory. Throws Error on all ranks if the file can't be written, because
/// the disk is full, say: earlier checkpoints are then still there, and the
/// caller may go on.
std::string WriteCheckpoint(const std::string &directory,
                            BiphasicProblem &problem, TimeStepper &stepper,
                            const std::string &setup = "", int keep = 2);

/// A checkpoint as it was read.
class Checkpoint
{
public:
   /// Collective. Throws Error on all ranks if the file can't be read, is
   /// damaged or no checkpoint.
   Checkpoint(const std::string &file, MPI_Comm comm);

   const std::string &File() const { return file; }
   mfem::real_t Time() const { return time; }
   /// Accepted steps until then.
   int Steps() const { return steps; }
   /// The case as text; empty if the program that wrote it had none, or was of
   /// a version that did not keep it.
   const std::string &Setup() const { return setup; }

   /// Sets @a problem and @a stepper to what they were when it was written.
   ///
   /// They must have been made like those: same mesh, order and contact pairs.
   /// The materials and conditions may differ, and so may the options of the
   /// stepper (end, step, scheme) and the number of ranks.
   ///
   /// Collective; each rank reads a part of each field. Throws Error on all
   /// ranks, before anything is changed, if it is one of another problem, and
   /// says in what; and if the file can't be read any more.
   void Restore(BiphasicProblem &problem, TimeStepper &stepper) const;

private:
   std::string file;
   MPI_Comm comm;
   CheckpointContents contents; // rank 0 only
   std::string setup;
   mfem::real_t time = 0.0;
   int steps = 0;
};

/// Reads a checkpoint and restores it. Throws as both do.
void ReadCheckpoint(const std::string &file, BiphasicProblem &problem,
                    TimeStepper &stepper);

} // namespace synovia
