#include "synovia/time/step_control.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace synovia
{

using namespace mfem;

namespace
{
// An error that falls with less than this power of the step is a jump.
constexpr real_t jump_order = 0.1;
// In the first step after a load changes, stiff modes make it fall slowly.
constexpr real_t least_order = 0.25;
constexpr real_t round_off = 1e-9;
} // namespace

StepControl::StepControl(const StepLimits &limits_, const StepTuning &tuning_)
   : limits(limits_), tuning(tuning_), length(limits.first)
{
}

void StepControl::Plan(real_t planned)
{
   if (limits.adaptive)
   {
      return;
   }
   length = IsCut() ? std::min(length, planned) : planned;
   limits.first = planned;
}

bool StepControl::Fail(real_t dt)
{
   failures++;
   if (!limits.cut_back || dt <= limits.shortest * (1.0 + round_off))
   {
      return false;
   }
   length = std::max(limits.shortest, 0.5 * dt);
   return true;
}

StepControl::Verdict StepControl::Judge(const StepAttempt &step)
{
   if (!limits.adaptive || step.error <= limits.tolerance ||
       step.dt <= limits.shortest * (1.0 + round_off) ||
       rejections >= tuning.max_rejections)
   {
      return Verdict::accept;
   }
   real_t order = step.order;
   if (rejections > 0 && step.dt < rejected_dt)
   {
      const real_t observed = std::log(rejected_error / step.error) /
                              std::log(rejected_dt / step.dt);
      if (observed < jump_order)
      {
         return Verdict::accept_jump;
      }
      order = std::clamp(observed, least_order, order);
   }
   rejections++;
   rejected_dt = step.dt;
   rejected_error = step.error;
   const real_t factor =
      tuning.safety * std::pow(limits.tolerance / step.error, 1.0 / order);
   length =
      std::max(limits.shortest,
               step.dt * std::clamp(factor, tuning.most_cut, tuning.safety));
   return Verdict::repeat;
}

void StepControl::Grow(const StepAttempt &step)
{
   const bool hard = step.newton > tuning.hard_newton;
   const bool tried_again = failures > 0 || rejections > 0;
   failures = 0;
   rejections = 0;
   if (!limits.adaptive)
   {
      const real_t next = hard ? step.dt : 2.0 * step.dt;
      length = std::min(limits.first, std::max(length, next));
      return;
   }
   const real_t allowed =
      step.error > 0.0
         ? step.dt * tuning.safety *
              std::pow(limits.tolerance / step.error, 1.0 / step.order)
         : std::numeric_limits<real_t>::max();
   real_t next = std::min(
      allowed, (hard || tried_again ? 1.0 : tuning.most_growth) * step.dt);
   if (next > step.dt && next < tuning.least_growth * step.dt)
   {
      next = step.dt;
   }
   if (step.dt < length * (1.0 - round_off))
   {
      // It was short to end on time, which says nothing against longer ones.
      next = std::max(next, std::min(allowed, length));
   }
   length = std::clamp(next, limits.shortest, limits.longest);
}

void StepControl::Archive(StateArchive &archive)
{
   archive.Number("step.length", length);
   bool cut = IsCut();
   archive.Flag("step.cut", cut);
   if (!archive.Reads())
   {
      return;
   }
   // The limits may differ from those of the run that wrote the checkpoint.
   failures = 0;
   rejections = 0;
   if (limits.adaptive)
   {
      length = std::clamp(length, limits.shortest, limits.longest);
   }
   else
   {
      length = cut ? std::min(length, limits.first) : limits.first;
   }
}

} // namespace synovia
