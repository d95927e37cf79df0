#pragma once

#include "mfem.hpp"

#include "synovia/general/profiled_phase.hpp"

namespace synovia
{

/// Adds the wall time that it lives (s) to a counter, which it borrows, and is
/// a phase for profilers meanwhile.
class PhaseTimer
{
public:
   PhaseTimer(mfem::real_t &counter_, const char *name)
      : phase(name), counter(counter_)
   {
      watch.Start();
   }
   ~PhaseTimer() { counter += watch.RealTime(); }
   PhaseTimer(const PhaseTimer &) = delete;
   PhaseTimer &operator=(const PhaseTimer &) = delete;

private:
   ProfiledPhase phase;
   mfem::real_t &counter;
   mfem::StopWatch watch;
};

} // namespace synovia
