// Times each rank's work, for programs whose MPI it intercepts:
//
//   LD_PRELOAD=libsynovia_work_clock.so SYNOVIA_WORK_TIMES=times
//
// writes times.RANK.csv when MPI is finalized: a row for each phase that
// ProfiledPhase names, and one for each piece of work in it that ProfiledWork
// names, nested ones by the names of all, with how often it was done, for how
// long (s), without what is nested in it, and the bytes that it said it reads.
// All ranks must do the same work: they wait for each other at its end, and the
// time of that is the phase's work "waiting".
// The last row, "memory", has the time of reading an array, on all ranks at
// once, and its bytes.

#include <mpi.h>

#include <algorithm>
#include <cstdarg>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace
{
struct Work
{
   long long calls = 0;
   double seconds = 0.0;
   double bytes = 0.0;
};

class Clock
{
public:
   void EnterPhase(const std::string &name) { Enter({name, ""}, 0.0); }
   void EnterWork(const std::string &name, double bytes)
   {
      Key key = open.empty() ? Key("other", "") : open.back().key;
      key.second += (key.second.empty() ? "" : " ") + name;
      Enter(key, bytes);
   }
   void LeavePhase() { Leave(PMPI_Wtime()); }
   void LeaveWork()
   {
      const double end = PMPI_Wtime();
      const std::string phase = open.empty() ? "other" : open.back().key.first;
      PMPI_Barrier(MPI_COMM_WORLD);
      Work &waiting = works[{phase, "waiting"}];
      waiting.calls++;
      waiting.seconds += PMPI_Wtime() - end;
      Leave(end);
   }
   void Write(const std::string &file, const Work &memory) const
   {
      std::ofstream out(file);
      out << std::setprecision(12) << "phase,work,calls,seconds,bytes\n";
      for (const auto &[key, work] : works)
      {
         out << key.first << ',' << key.second << ',' << work.calls << ','
             << work.seconds << ',' << work.bytes << '\n';
      }
      out << "memory,," << memory.calls << ',' << memory.seconds << ','
          << memory.bytes << '\n';
   }

private:
   /// Phase, and names of the work in it.
   using Key = std::pair<std::string, std::string>;
   struct Frame
   {
      Key key;
      double begin;
      double bytes;
      double nested = 0.0;
   };
   void Enter(const Key &key, double bytes)
   {
      open.push_back({key, PMPI_Wtime(), bytes});
   }
   void Leave(double end)
   {
      if (open.empty())
      {
         return;
      }
      const Frame frame = open.back();
      open.pop_back();
      Work &work = works[frame.key];
      work.calls++;
      work.seconds += end - frame.begin - frame.nested;
      work.bytes += frame.bytes;
      if (!open.empty())
      {
         open.back().nested += PMPI_Wtime() - frame.begin;
      }
   }

   std::map<Key, Work> works;
   std::vector<Frame> open;
};

// MPI may be finalized by the destructor of a static object, after those of
// this library: what it counts in is never destroyed.
Clock &TheClock()
{
   static Clock *const clock = std::make_unique<Clock>().release();
   return *clock;
}

// The best of some readings of an array that no cache holds.
Work ReadMemory()
{
   constexpr std::size_t entries = std::size_t(1) << 24;
   constexpr int readings = 8;
   const std::vector<double> array(entries, 1.0);
   Work best;
   best.calls = readings;
   best.bytes = sizeof(double) * static_cast<double>(entries);
   best.seconds = std::numeric_limits<double>::max();
   for (int i = 0; i < readings; i++)
   {
      PMPI_Barrier(MPI_COMM_WORLD);
      const double begin = PMPI_Wtime();
      // Several sums, as one would wait for each addition.
      double sums[8] = {0.0};
      for (std::size_t k = 0; k < entries; k += 8)
      {
         for (int j = 0; j < 8; j++)
         {
            sums[j] += array[k + j];
         }
      }
      const volatile double sum = std::accumulate(sums, sums + 8, 0.0);
      static_cast<void>(sum);
      best.seconds = std::min(best.seconds, PMPI_Wtime() - begin);
   }
   return best;
}
} // namespace

extern "C"
{

   int MPI_Pcontrol(const int level, ...)
   {
      va_list arguments;
      va_start(arguments, level);
      if (level == 1)
      {
         TheClock().EnterPhase(va_arg(arguments, const char *));
      }
      else if (level == 2)
      {
         const char *name = va_arg(arguments, const char *);
         TheClock().EnterWork(name, va_arg(arguments, double));
      }
      else if (level == -1)
      {
         TheClock().LeavePhase();
      }
      else if (level == -2)
      {
         TheClock().LeaveWork();
      }
      va_end(arguments);
      return MPI_SUCCESS;
   }

   int MPI_Finalize()
   {
      if (const char *file = std::getenv("SYNOVIA_WORK_TIMES"))
      {
         int rank = 0;
         PMPI_Comm_rank(MPI_COMM_WORLD, &rank);
         TheClock().Write(std::string(file) + "." + std::to_string(rank) +
                             ".csv",
                          ReadMemory());
      }
      return PMPI_Finalize();
   }
}
