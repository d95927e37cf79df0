#pragma once

#include <optional>

namespace synovia
{

/// Estimates how long a run still takes, from what its steps took so far.
///
/// The first step is left out, as its set-up is used by all others; later steps
/// count more. As long as the number of steps to come is uncertain, while
/// adaptive steps grow for one, there is no estimate.
class RemainingTime
{
public:
   /// A step, with its output, took so many seconds, and so many are left.
   void Add(double seconds, int steps_left);

   /// In seconds; none before it means something.
   std::optional<double> Seconds() const;

private:
   int steps = 0;
   int left = 0;
   bool settled = false;
   double weighted_seconds = 0.0;
   double weights = 0.0;
};

} // namespace synovia
