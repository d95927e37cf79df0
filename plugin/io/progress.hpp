#pragma once

#include "synovia/io/remaining_time.hpp"
#include "synovia/time/time_stepper.hpp"

namespace synovia
{

/// Shows the progress of a run: one line that is kept up to date on a terminal,
/// a line now and then in a log. Rank 0 writes to standard output.
class Progress
{
public:
   explicit Progress(MPI_Comm comm);

   /// Call after each accepted step, with how many are left.
   void Report(const StepReport &report, int left);

   /// Call before anything else is written: ends a line that stands open.
   void EndLine();

private:
   bool writes;
   bool terminal;
   bool open = false;
   int step = 0;
   int linear = 0;
   double last_line = 0.0;
   double last_step = 0.0;
   RemainingTime remaining;
   mfem::StopWatch watch;
};

} // namespace synovia
