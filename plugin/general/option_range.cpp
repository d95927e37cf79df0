#include "synovia/general/option_range.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/text.hpp"

#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
void Verify(bool good, const std::string &option, real_t value,
            const std::string &range)
{
   if (!good || !std::isfinite(value))
   {
      throw Error(option + " is " + ToText(value) + "; it must be " + range);
   }
}
} // namespace

void VerifyPositive(const std::string &option, real_t value)
{
   Verify(value > 0.0, option, value, "positive");
}

void VerifyAtLeast(const std::string &option, real_t value, real_t least)
{
   Verify(value >= least, option, value, "at least " + ToText(least));
}

void VerifyFrom(const std::string &option, real_t value, real_t least,
                real_t most)
{
   Verify(value >= least && value <= most, option, value,
          "from " + ToText(least) + " to " + ToText(most));
}

void VerifyBetween(const std::string &option, real_t value, real_t low,
                   real_t high)
{
   Verify(value > low && value < high, option, value,
          "between " + ToText(low) + " and " + ToText(high));
}

} // namespace synovia
