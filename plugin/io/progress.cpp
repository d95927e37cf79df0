#include "synovia/io/progress.hpp"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <unistd.h>

namespace synovia
{

using namespace mfem;

namespace
{
// Seconds between lines of a log.
constexpr double log_interval = 10.0;

// Open MPI's mpirun gives each program a terminal of its own to write to,
// wherever its own output goes, which is what matters then.
bool WritesToTerminal()
{
   if (isatty(STDOUT_FILENO) == 0)
   {
      return false;
   }
   if (std::getenv("OMPI_COMM_WORLD_RANK") == nullptr)
   {
      return true;
   }
   std::error_code error;
   const std::string output =
      std::filesystem::read_symlink(
         "/proc/" + std::to_string(getppid()) + "/fd/1", error)
         .string();
   return output.rfind("/dev/pts/", 0) == 0 || output.rfind("/dev/tty", 0) == 0;
}

std::string LeftText(const RemainingTime &remaining)
{
   const std::optional<double> seconds = remaining.Seconds();
   if (!seconds)
   {
      return "";
   }
   char text[32];
   std::snprintf(text, sizeof(text), ", %.0f s left", *seconds);
   return text;
}
} // namespace

Progress::Progress(MPI_Comm comm)
{
   int rank;
   MPI_Comm_rank(comm, &rank);
   writes = rank == 0;
   terminal = WritesToTerminal();
   watch.Start();
}

void Progress::Report(const StepReport &report, int left)
{
   step++;
   linear += report.solve.linear;
   if (!writes)
   {
      return;
   }
   const double elapsed = watch.RealTime();
   remaining.Add(elapsed - last_step, left);
   last_step = elapsed;
   const bool last = left == 0;
   if (!terminal && !last && step > 1 && elapsed - last_line < log_interval)
   {
      return;
   }
   last_line = elapsed;
   std::printf("%sstep %d/%d  t %.6g  dt %.4g  newton %d  augmentations %d  "
               "linear %d  area %.4g  %.0f s%s%s",
               terminal ? "\r\033[K" : "", step, step + left, report.time,
               report.dt, report.solve.newton, report.solve.augmentations,
               report.solve.linear, report.contact_area, elapsed,
               LeftText(remaining).c_str(), terminal && !last ? "" : "\n");
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
