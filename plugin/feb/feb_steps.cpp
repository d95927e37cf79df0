#include "synovia/feb/feb_steps.hpp"

#include <algorithm>
#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
// More than anybody waits for.
constexpr size_t most_steps = 1000000;
constexpr real_t longest_stride = 1e6;
constexpr real_t round_off = 1e-12;
// How FEBio lets its steps grow.
constexpr real_t largest_growth = 5.0;
constexpr real_t part_of_way = 0.2;

/// Where FEBio's steps must end, in turn.
class MustPoints
{
public:
   /// None if there is no @a curve.
   explicit MustPoints(const FebCurve *curve_) : curve(curve_) {}

   /// The first one after @a t; @a end if there is none.
   real_t After(real_t t, real_t end) const
   {
      if (!curve)
      {
         return end;
      }
      const std::vector<real_t> &times = curve->Times();
      const real_t beyond = t + round_off * end;
      const real_t period = times.back();
      const real_t offset = curve->Repeats() && period > 0.0
                               ? period * std::floor(beyond / period)
                               : 0.0;
      for (const real_t time : times)
      {
         if (time + offset > beyond)
         {
            return time + offset;
         }
      }
      return end;
   }

private:
   const FebCurve *curve;
};

std::vector<real_t> AutomaticSteps(const FebInput &stepper, real_t first,
                                   real_t begin, real_t end,
                                   const FebCurves &curves)
{
   const real_t shortest = stepper.Number("dtmin", 0.0);
   const std::optional<FebInput> longest_input = stepper.Find("dtmax");
   const FebCurve *curve =
      longest_input ? FindCurve(*longest_input, curves) : nullptr;
   const real_t constant = longest_input ? longest_input->Number() : 0.1;
   const MustPoints must(curve);
   std::vector<real_t> ends;
   real_t t = begin;
   real_t length = std::max(first, shortest);
   while (t < end * (1.0 - round_off) && ends.size() < most_steps)
   {
      const real_t longest = curve ? (*curve)(t) : constant;
      if (!ends.empty())
      {
         length = std::min(std::max(length, shortest) +
                              part_of_way * (longest - length),
                           largest_growth * length);
      }
      if (longest > 0.0)
      {
         length = std::min(length, longest);
      }
      if (!(length > round_off * end))
      {
         stepper.Stop("the steps become ever shorter");
         return {end};
      }
      const real_t stop = std::min(must.After(t, end), end);
      t = stop < t + length + round_off * end ? stop : t + length;
      ends.push_back(t);
   }
   if (ends.size() == most_steps)
   {
      stepper.Stop("there are too many steps");
   }
   return ends;
}

// Whether it is for steady states. A word, or before version 3.0 the attribute
// of an element.
bool ReadAnalysis(const FebInput &section, const std::string &module)
{
   const std::optional<FebInput> analysis = section.Find("analysis");
   if (!analysis)
   {
      return false;
   }
   const std::string attribute = analysis->Attribute("type");
   const std::string type = attribute.empty() ? analysis->Text() : attribute;
   const auto is = [&type](const char *upper, const char *lower)
   { return type == upper || type == lower; };
   // What solids do at rest depends on the loads of the moment.
   const bool at_rest = module == "solid" && is("STATIC", "static");
   const bool steady = is("STEADY-STATE", "steady-state");
   if (!at_rest && !steady && !is("TRANSIENT", "transient"))
   {
      analysis->Stop("found \"" + type +
                     "\"; there are TRANSIENT, STEADY-STATE, and STATIC in "
                     "the module solid");
   }
   return steady;
}

void ReadOutputLevel(const FebInput &section, FebSteps &steps)
{
   steps.fields_every = static_cast<int>(std::min(
      std::max(section.Number("plot_stride", 1.0), 1.0), longest_stride));
   if (section.Word("plot_level", "") == "PLOT_NEVER")
   {
      steps.fields_every = 0;
   }
   for (const char *name :
        {"plot_zero_state", "plot_range", "output_level", "output_stride"})
   {
      section.Ignore(name, "each step is a row of history.csv");
   }
}
} // namespace

TimeOptions FebSteps::Options() const
{
   TimeOptions options;
   options.end = ends.back();
   options.step = length;
   if (length == 0.0)
   {
      real_t before = 0.0;
      for (const real_t end : ends)
      {
         options.step = std::max(options.step, end - before);
         before = end;
      }
      options.stops.assign(ends.begin(), ends.end() - 1);
   }
   return options;
}

FebSteps ReadControl(const FebInput &section, const std::string &module,
                     const FebCurves &curves, real_t begin)
{
   FebSteps steps;
   steps.steady = ReadAnalysis(section, module);
   const real_t count = section.Number("time_steps", 10.0);
   const real_t first = section.Number("step_size", 0.1);
   ReadOutputLevel(section, steps);
   // Settings of the solver were here before version 3.0.
   for (const char *name :
        {"solver", "dtol", "etol", "rtol", "ptol", "lstol", "lsmin", "lsiter",
         "max_refs", "max_ups", "diverge_reform", "reform_each_time_step",
         "reform_augment", "min_residual", "max_residual", "qnmethod", "cmax",
         "optimize_bw", "symmetric_stiffness"})
   {
      section.Ignore(name, "Newton's method has its own settings here");
   }
   section.Ignore("adaptor_re_solve", "there is no mesh adaptor");
   steps.ends = {begin + 1.0};
   steps.length = 1.0;
   if (!(count >= 1.0 && count <= 1e12 && first > 0.0))
   {
      section.Stop("time_steps and step_size must be positive");
      return steps;
   }
   const real_t end = begin + count * first;
   const std::optional<FebInput> stepper = section.Find("time_stepper");
   if (!stepper)
   {
      if (count > most_steps)
      {
         section.Stop("there are too many steps");
         return steps;
      }
      steps.length = first;
      steps.ends.clear();
      for (int i = 1; i <= static_cast<int>(count); i++)
      {
         steps.ends.push_back(begin + i * first);
      }
      return steps;
   }
   stepper->Attribute("type");
   stepper->Expect("dtforce", false, "steps of a given length are not known");
   for (const char *name :
        {"max_retries", "opt_iter", "aggressiveness", "cutback"})
   {
      stepper->Ignore(name, "a step that fails is cut in half");
   }
   steps.ends = AutomaticSteps(*stepper, first, begin, end, curves);
   steps.length = 0.0;
   stepper->Approximate("its steps depend on its iterations; time.stops are "
                        "those that it takes where these are few");
   return steps;
}

} // namespace synovia
