#include "synovia/runs/stabilization_record.hpp"
#include "synovia/general/text.hpp"
#include "synovia/runs/run_texts.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
constexpr real_t most = 0.05;

std::string FlowText(const StrainExtreme &part)
{
   constexpr real_t percent = 100.0;
   return "the stabilization of order 1 stands for a flow of " +
          ToText(percent * part.value) + " % of the volume around a vertex, " +
          PlaceText(part);
}
} // namespace

std::string StabilizationRecord::Add(const StrainExtreme &part, real_t time)
{
   if (part.value > largest.value)
   {
      largest = part;
      largest_time = time;
   }
   if (warned || !(part.value > most))
   {
      return "";
   }
   warned = true;
   return "at t = " + ToText(time) + " " + FlowText(part) +
          ", as meshed: pressures differ within an element by about as much as "
          "its solid is stiff; take space.order = 2, or smaller elements, for "
          "strains and volumes there";
}

std::string StabilizationRecord::Summary() const
{
   return warned ? FlowText(largest) + ", t = " + ToText(largest_time) +
                      ", the largest one"
                 : "";
}

} // namespace synovia
