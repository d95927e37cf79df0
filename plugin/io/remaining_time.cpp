#include "synovia/io/remaining_time.hpp"

#include <cmath>

namespace synovia
{

namespace
{
// Weight of a step over that of the one after it: about the last ten count.
constexpr double fading = 0.9;
// Steps without the first from which a mean is worth something.
constexpr int fewest_steps = 2;
// By what part two predictions of the number of all steps may differ.
constexpr double uncertainty = 0.25;
} // namespace

void RemainingTime::Add(double seconds, int steps_left)
{
   const double predicted = steps + left;
   steps++;
   left = steps_left;
   const double total = steps + left;
   settled = std::abs(total - predicted) <= uncertainty * total;
   if (steps > 1)
   {
      weighted_seconds = fading * weighted_seconds + seconds;
      weights = fading * weights + 1.0;
   }
}

std::optional<double> RemainingTime::Seconds() const
{
   if (steps > 0 && left == 0)
   {
      return 0.0;
   }
   if (!settled || steps <= fewest_steps)
   {
      return std::nullopt;
   }
   return left * weighted_seconds / weights;
}

} // namespace synovia
