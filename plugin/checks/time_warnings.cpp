#include "synovia/checks/time_warnings.hpp"
#include "synovia/checks/load_times.hpp"
#include "synovia/general/text_table.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

namespace
{
// Lengths of time that differ by less are the same.
constexpr real_t round_off = 1e-9;
} // namespace

std::vector<std::string> FindTimeWarnings(const CaseFile &setup)
{
   std::vector<std::string> warnings;
   const LoadTimes loads = FindLoadTimes(setup);
   if (loads.last > setup.time.end)
   {
      warnings.push_back(WhereIs(setup.places, "time.end") +
                         ": loads change until " + Quantity(loads.last) +
                         ", and the run ends at " + Quantity(setup.time.end));
   }
   for (size_t i = 0; i < setup.output.lines.size(); i++)
   {
      const LineCase &line = setup.output.lines[i];
      for (const real_t time : line.times)
      {
         if (time > setup.time.end * (1.0 + round_off))
         {
            warnings.push_back(
               WhereIs(setup.places,
                       "output.line." + std::to_string(i) + ".times") +
               ": the line \"" + line.line.name + "\" is not sampled at " +
               Quantity(time) + ", for the run ends at " +
               Quantity(setup.time.end));
         }
      }
   }
   return warnings;
}

} // namespace synovia
