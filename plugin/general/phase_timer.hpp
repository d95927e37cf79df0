#pragma once

#include "mfem.hpp"

namespace synovia
{

/// Adds the wall time that it lives (s) to a counter, which it borrows.
class PhaseTimer
{
public:
   explicit PhaseTimer(mfem::real_t &counter_) : counter(counter_)
   {
      watch.Start();
   }
   ~PhaseTimer() { counter += watch.RealTime(); }
   PhaseTimer(const PhaseTimer &) = delete;
   PhaseTimer &operator=(const PhaseTimer &) = delete;

private:
   mfem::real_t &counter;
   mfem::StopWatch watch;
};

} // namespace synovia
