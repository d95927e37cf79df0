#include "synovia/cases/step_checks.hpp"
#include "synovia/cases/case_checks.hpp"
#include "synovia/cases/case_steps.hpp"
#include "synovia/cases/key_names.hpp"
#include "synovia/cases/name_checks.hpp"
#include "synovia/general/text.hpp"

#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
// More time steps than anybody waits for: a slip of the pen.
constexpr real_t most_steps = 1e7;
// Ends that differ by this part are the same.
constexpr real_t same_end = 1e-9;

// What each step has by itself.
void CheckEachStep(const CaseFile &setup, CaseReading &reading)
{
   Once names(reading);
   for (size_t i = 0; i < setup.steps.size(); i++)
   {
      const StepCase &step = setup.steps[i];
      const std::string path = EntryPath("step", i);
      reading.Require(!step.name.empty(), path + ".name", "the name is empty");
      if (!step.name.empty())
      {
         names.Enter(step.name, path + ".name",
                     "a step is called " + Quoted(step.name) + " already");
         CheckFileName(step.name, path + ".name", reading);
      }
      Once boundaries(reading);
      for (size_t k = 0; k < step.boundaries.size(); k++)
      {
         const std::string &name = step.boundaries[k].name;
         if (!name.empty())
         {
            boundaries.Enter(name, EntryPath(path + ".boundary", k, "name"),
                             "this step has a boundary " + Quoted(name) +
                                " already");
         }
      }
      Once bodies(reading);
      for (size_t k = 0; k < step.rigid_bodies.size(); k++)
      {
         bodies.Enter(step.rigid_bodies[k].name,
                      EntryPath(path + ".rigid_body", k, "name"),
                      "this step moves " + Quoted(step.rigid_bodies[k].name) +
                         " already");
      }
   }
}
} // namespace

void CheckStepLengths(real_t duration, const std::string &meaning,
                      const TimeOptions &time, const std::string &path,
                      CaseReading &reading)
{
   const real_t steps =
      duration > 0.0 && time.step > 0.0 ? duration / time.step : 0.0;
   reading.Require(steps <= most_steps, path + ".step",
                   "the " + meaning + " of " + ToText(duration) +
                      " would take " + ToText(steps) +
                      " time steps; that is too many");
   reading.Require(time.growth >= 1.0, path + ".growth",
                   "found " + ToText(time.growth) + "; it must be at least 1");
   reading.Require(!(time.adaptive && time.growth > 1.0), path + ".growth",
                   "adaptive steps have lengths of their own; leave this out");
   reading.Require(!(time.min_step > time.step), path + ".min_step",
                   "found " + ToText(time.min_step) +
                      "; it must not be above the time step, " +
                      ToText(time.step));
   reading.Require(
      !(time.max_step > 0.0 && time.max_step < time.step), path + ".max_step",
      "found " + ToText(time.max_step) +
         "; it must be at least the time step, " + ToText(time.step));
}

void CheckSteps(const CaseFile &setup, CaseReading &reading)
{
   if (setup.steps.empty())
   {
      return;
   }
   CheckEachStep(setup, reading);
   const real_t end = EndOfSteps(setup.steps);
   reading.Require(
      end <= 0.0 || std::abs(setup.time.end - end) <= same_end * end,
      "time.end",
      "found " + ToText(setup.time.end) + ", but the steps end at " +
         ToText(end) + "; leave this out");
   CaseFile placed(setup);
   placed.places = reading.Places();
   const std::vector<CaseOfStep> steps = CasesOfSteps(placed, reading);
   for (size_t i = 0; i < steps.size(); i++)
   {
      CheckStepLengths(setup.steps[i].duration, "duration", steps[i].setup.time,
                       EntryPath("step", i), reading);
      if (reading.Count() > 0)
      {
         // They would be found in each of the steps that follow.
         return;
      }
      CaseReading here(steps[i].setup.places);
      CheckConditions(steps[i].setup, here);
      reading.Append(here, "in the step " + Quoted(steps[i].name) + ": ");
   }
}

} // namespace synovia
