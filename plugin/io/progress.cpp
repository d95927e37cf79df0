#include "io/progress.hpp"

#include <cstdio>
#include <unistd.h>

namespace synovia
{

using namespace mfem;

namespace
{
// Seconds between lines of a log.
constexpr double log_interval = 10.0;
} // namespace

Progress::Progress(MPI_Comm comm)
{
   int rank;
   MPI_Comm_rank(comm, &rank);
   writes = rank == 0;
   terminal = isatty(STDOUT_FILENO) != 0;
   watch.Start();
}

void Progress::Report(const StepReport &report, const TimeStepper &stepper)
{
   step++;
   linear += report.solve.linear;
   if (!writes)
   {
      return;
   }
   const double elapsed = watch.RealTime();
   const int left = stepper.StepsLeft();
   const bool last = left == 0;
   if (!terminal && !last && step > 1 && elapsed - last_line < log_interval)
   {
      return;
   }
   last_line = elapsed;
   std::printf("%sstep %d/%d  t %.6g  dt %.4g  newton %d  augmentations %d  "
               "linear %d  area %.4g  %.0f s, %.0f s left%s",
               terminal ? "\r\033[K" : "", step, step + left, report.time,
               report.dt, report.solve.newton, report.solve.augmentations,
               report.solve.linear, report.contact_area, elapsed,
               elapsed / step * left, terminal && !last ? "" : "\n");
   std::fflush(stdout);
   open = terminal && !last;
}

void Progress::EndLine()
{
   if (open)
   {
      std::printf("\n");
      std::fflush(stdout);
      open = false;
   }
}

} // namespace synovia
