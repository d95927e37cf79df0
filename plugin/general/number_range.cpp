#include "synovia/general/number_range.hpp"
#include "synovia/general/text.hpp"

#include <cmath>

namespace synovia
{

using namespace mfem;

NumberRange NumberRange::Positive()
{
   return Above(0.0);
}

NumberRange NumberRange::AtLeast(real_t least)
{
   NumberRange range;
   range.least = least;
   return range;
}

NumberRange NumberRange::Above(real_t least)
{
   NumberRange range = AtLeast(least);
   range.open = true;
   return range;
}

NumberRange NumberRange::From(real_t least, real_t most)
{
   return {least, most, false};
}

NumberRange NumberRange::Inside(real_t least, real_t most)
{
   return {least, most, true};
}

bool NumberRange::Has(real_t value) const
{
   return open ? value > least && value < most
               : value >= least && value <= most;
}

std::string NumberRange::Text() const
{
   const bool above = std::isfinite(least);
   const bool below = std::isfinite(most);
   if (below)
   {
      return std::string(open ? "between " : "from ") + ToText(least) +
             (open ? " and " : " to ") + ToText(most);
   }
   if (!above)
   {
      return "";
   }
   if (open)
   {
      return least == 0.0 ? "positive" : "above " + ToText(least);
   }
   return "at least " + ToText(least);
}

} // namespace synovia
