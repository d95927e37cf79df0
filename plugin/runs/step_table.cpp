#include "synovia/runs/step_table.hpp"
#include "synovia/cases/case_steps.hpp"
#include "synovia/general/text_table.hpp"

#include <ostream>

namespace synovia
{

void WriteSteps(const CaseFile &setup, std::ostream &out)
{
   if (setup.steps.empty())
   {
      return;
   }
   out << "\nsteps\n";
   const auto length = [](const TimeOptions &time)
   {
      return Quantity(time.step) + (time.adaptive ? ", adaptive" : "") +
             (time.growth > 1.0 ? ", times " + Quantity(time.growth) : "");
   };
   std::vector<std::vector<std::string>> rows{
      {"", "from", "to", "time step", "changes"}};
   const std::vector<CaseOfStep> steps = CasesOfSteps(setup);
   for (size_t i = 0; i < steps.size(); i++)
   {
      const TimeOptions &time = steps[i].setup.time;
      rows.push_back({steps[i].name, Quantity(steps[i].begin),
                      Quantity(steps[i].end), length(time),
                      ChangesText(setup.steps[i])});
   }
   WriteTable(out, rows);
}

} // namespace synovia
