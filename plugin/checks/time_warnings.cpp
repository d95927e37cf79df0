#include "checks/time_warnings.hpp"
#include "checks/load_times.hpp"
#include "general/text_table.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

namespace
{
// Loads and gel times that are farther apart than this look like a mistake.
constexpr real_t far_apart = 1e3;
// Lengths of time that differ by less are the same.
constexpr real_t round_off = 1e-9;

void CompareWithGelTimes(const LoadTimes &loads,
                         const std::vector<RegionMeasures> &regions,
                         std::vector<std::string> &warnings)
{
   real_t shortest = std::numeric_limits<real_t>::infinity();
   real_t longest = 0.0;
   for (const RegionMeasures &region : regions)
   {
      if (region.gel_time > 0.0)
      {
         shortest = std::min(shortest, region.gel_time);
         longest = std::max(longest, region.gel_time);
      }
   }
   if (longest > 0.0 && loads.longest > far_apart * longest)
   {
      warnings.push_back("a load takes " + Quantity(loads.longest) +
                         ", which is much slower than any gel time (" +
                         Quantity(longest) +
                         " at most): there will be hardly any fluid pressure; "
                         "are the units of the permeability right?");
   }
   if (longest > 0.0 && loads.shortest * far_apart < shortest)
   {
      warnings.push_back("a load takes " + Quantity(loads.shortest) +
                         ", which is much faster than any gel time (" +
                         Quantity(shortest) +
                         " at least): hardly any fluid will move; are the "
                         "units of the permeability right?");
   }
}
} // namespace

std::vector<std::string>
FindTimeWarnings(const CaseFile &setup,
                 const std::vector<RegionMeasures> &regions)
{
   std::vector<std::string> warnings;
   const LoadTimes loads = FindLoadTimes(setup);
   CompareWithGelTimes(loads, regions, warnings);
   if (loads.last > setup.time.end)
   {
      warnings.push_back("loads change until " + Quantity(loads.last) +
                         ", and the run ends at " + Quantity(setup.time.end));
   }
   for (const LineCase &line : setup.output.lines)
   {
      for (const real_t time : line.times)
      {
         if (time > setup.time.end * (1.0 + round_off))
         {
            warnings.push_back("the line \"" + line.line.name +
                               "\" is not sampled at " + Quantity(time) +
                               ", for the run ends at " +
                               Quantity(setup.time.end));
         }
      }
   }
   return warnings;
}

} // namespace synovia
