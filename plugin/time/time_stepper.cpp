#include "synovia/time/time_stepper.hpp"
#include "synovia/contact/contact_diagnostics.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/text.hpp"
#include "synovia/time/sdirk2_solver.hpp"

#include <algorithm>
#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
// Steps shorter than this part of the shortest wanted are merged with the one
// before.
constexpr real_t same_part = 1e-6;
constexpr real_t end_tolerance = 1e-13;
// Enough for an estimate of how many are left between two stops.
constexpr real_t most_steps = 1e6;

std::unique_ptr<ODESolver> MakeSolver(TimeScheme scheme)
{
   switch (scheme)
   {
   case TimeScheme::sdirk23:
      return std::make_unique<Sdirk2Solver>();
   case TimeScheme::sdirk33:
      return std::make_unique<SDIRK33Solver>();
   default:
      return std::make_unique<BackwardEulerSolver>();
   }
}

void Verify(bool good, const std::string &what, real_t value,
            const std::string &must)
{
   if (!good)
   {
      throw Error(what + " is " + ToText(value) + "; it must be " + must);
   }
}

TimeOptions Checked(const TimeOptions &given)
{
   TimeOptions options(given);
   const auto positive = [](real_t x) { return x > 0.0 && std::isfinite(x); };
   Verify(positive(options.step), "the time step", options.step, "positive");
   Verify(positive(options.end), "the end time", options.end, "positive");
   Verify(positive(options.error_tolerance) && options.error_tolerance < 1.0,
          "error_tolerance", options.error_tolerance, "between 0 and 1");
   Verify(options.min_step >= 0.0 && options.min_step <= options.step,
          "min_step", options.min_step,
          "positive and not above the time step, " + ToText(options.step) +
             ", or 0 (derived)");
   Verify(options.growth >= 1.0 && std::isfinite(options.growth), "growth",
          options.growth, "at least 1");
   Verify(!options.adaptive || options.growth == 1.0, "growth", options.growth,
          "left out where steps are adaptive");
   const bool same_lengths = !options.adaptive && options.growth == 1.0;
   if (!same_lengths && options.max_step != 0.0)
   {
      Verify(options.max_step >= options.step &&
                std::isfinite(options.max_step),
             "max_step", options.max_step,
             "at least the time step, " + ToText(options.step) +
                ", or 0 (derived)");
   }
   for (const real_t stop : options.stops)
   {
      Verify(std::isfinite(stop), "a time at which a step shall end", stop,
             "a finite number");
   }
   if (options.min_step == 0.0)
   {
      options.min_step = 1e-3 * options.step;
   }
   if (same_lengths)
   {
      options.max_step = options.step;
   }
   else if (options.max_step == 0.0)
   {
      options.max_step =
         std::max(options.step, 0.1 * (options.end - options.begin));
   }
   return options;
}

// Before the whole is read, of which parts may have been on the device.
void ReadOnHost(const BlockVector &state)
{
   for (int i = 0; i < state.NumBlocks(); i++)
   {
      state.GetBlock(i).HostRead();
   }
}

// That long after the first step began.
real_t GrownLength(const TimeOptions &options, real_t passed)
{
   return std::min(options.max_step,
                   options.step + (options.growth - 1.0) * passed);
}

StepLimits Limits(const TimeOptions &options)
{
   StepLimits limits;
   limits.first = options.step;
   limits.shortest = options.min_step;
   limits.longest = options.max_step;
   limits.adaptive = options.adaptive;
   limits.cut_back = options.cut_back;
   limits.tolerance = options.error_tolerance;
   return limits;
}
} // namespace

int CountSteps(const TimeOptions &options, real_t duration)
{
   if (options.growth == 1.0)
   {
      return static_cast<int>(
         std::ceil(std::min(duration / options.step, most_steps)));
   }
   int count = 0;
   for (real_t t = 0.0; t < duration * (1.0 - end_tolerance); count++)
   {
      t += GrownLength(options, t);
   }
   return count;
}

TimeStepper::TimeStepper(BiphasicProblem &problem, const TimeOptions &options_)
   : op(problem.Operator()), options(Checked(options_)), recorder(op),
     solver(MakeSolver(options.scheme)),
     control(Limits(options), op.Options().tuning.steps),
     same_time(std::max(same_part *
                           (options.adaptive ? options.min_step : options.step),
                        end_tolerance * options.end)),
     state(problem.Spaces().Offsets()),
     displacement(&problem.Spaces().Displacement()),
     pressure(&problem.Spaces().Pressure())
{
   if (options.adaptive)
   {
      norm.emplace(op.Equations().Bodies().Tangent(),
                   problem.Spaces().Offsets());
   }
   SetStops(problem.Conditions().Corners());
   state = 0.0;
   state.GetBlock(0) = op.Start().displacement;
   state.SyncFromBlocks();
   velocity.SetSize(state.GetBlock(0).Size());
   velocity = 0.0;
   solver->Init(recorder);
   UpdateFields();
}

void TimeStepper::SetStops(const std::vector<real_t> &corners)
{
   for (const real_t corner : corners)
   {
      stops.push_back({corner, true});
   }
   for (const real_t stop : options.stops)
   {
      stops.push_back({stop, false});
   }
   const auto outside = [&](const Stop &stop)
   { return stop.time <= same_time || stop.time >= options.end - same_time; };
   stops.erase(std::remove_if(stops.begin(), stops.end(), outside),
               stops.end());
   // Of stops at the same time the corner comes first, and stays.
   std::stable_sort(stops.begin(), stops.end(),
                    [](const Stop &a, const Stop &b)
                    { return a.time < b.time; });
   std::vector<Stop> different;
   for (const Stop &stop : stops)
   {
      if (different.empty() || stop.time > different.back().time + same_time)
      {
         different.push_back(stop);
      }
      else if (stop.corner && !different.back().corner)
      {
         different.back() = stop;
      }
   }
   different.push_back({options.end, false});
   stops = different;
}

bool TimeStepper::Done() const
{
   return time >= options.end - same_time;
}

const TimeStepper::Stop &TimeStepper::NextStop(real_t from) const
{
   for (const Stop &stop : stops)
   {
      if (stop.time > from + same_time)
      {
         return stop;
      }
   }
   return stops.back();
}

real_t TimeStepper::PlannedLength(real_t from) const
{
   real_t begin = options.begin;
   for (const Stop &stop : stops)
   {
      if (stop.corner && stop.time <= from + same_time)
      {
         begin = std::max(begin, stop.time);
      }
   }
   return GrownLength(options, from - begin);
}

real_t TimeStepper::Target() const
{
   const real_t stop = NextStop(time).time;
   real_t landing = stop;
   if (!options.adaptive && goal <= stop - same_time)
   {
      landing = goal;
   }
   const real_t left = landing - time;
   const real_t length = control.Length();
   if (length >= left - same_time)
   {
      return landing;
   }
   // Two equal steps rather than a long one and a sliver.
   return time + (2.0 * length > left ? 0.5 * left : length);
}

int TimeStepper::StepsLeft() const
{
   real_t length = control.Length();
   if (options.adaptive && steps > 0)
   {
      length = std::max(length, time / steps);
   }
   int count = 0;
   real_t from = time;
   if (options.growth > 1.0)
   {
      while (from < options.end - same_time)
      {
         from = std::min(NextStop(from).time, from + PlannedLength(from));
         count++;
      }
      return count;
   }
   for (const Stop &stop : stops)
   {
      if (stop.time > from + same_time)
      {
         const real_t wanted = (stop.time - from - same_time) / length;
         count += static_cast<int>(std::ceil(std::min(wanted, most_steps)));
         from = stop.time;
      }
   }
   return count;
}

void TimeStepper::Solve(real_t t, real_t dt, BlockVector &x)
{
   recorder.Clear();
   // The scheme treats what the bodies conserve as it does u and p.
   Vector conserved;
   op.Equations().Bodies().GetConserved(x.GetBlock(0), conserved);
   if (conserved.Size() == 0)
   {
      solver->Step(x, t, dt);
   }
   else
   {
      ReadOnHost(x);
      Vector whole(op.Height());
      whole.SetVector(x, 0);
      whole.SetVector(conserved, x.Size());
      solver->Step(whole, t, dt);
      for (int i = 0; i < x.Size(); i++)
      {
         x[i] = whole[i];
      }
   }
   x.SyncToBlocks();
}

bool TimeStepper::Advance(real_t dt, Attempt &result)
{
   Solve(time, dt, result.state);
   if (!op.Report().converged || !options.adaptive)
   {
      return op.Report().converged;
   }
   Vector error =
      EstimateError(options.scheme, recorder, dt, {op.AcceptedRate(), last_dt});
   largest = std::max(largest, (*norm)(result.state));
   result.step.error = largest > 0.0 ? (*norm)(error) / largest : 0.0;
   result.step.order = EstimateOrder(options.scheme);
   result.last_dt = dt;
   return true;
}

bool TimeStepper::AdvanceInHalves(real_t dt, Attempt &result)
{
   BlockVector single(result.state);
   Solve(time, dt, single);
   if (!op.Report().converged)
   {
      return false;
   }
   largest = std::max(largest, (*norm)(single));
   op.RejectStep();
   Solve(time, 0.5 * dt, result.state);
   Solve(time + 0.5 * dt, 0.5 * dt, result.state);
   if (!op.Report().converged)
   {
      return false;
   }
   largest = std::max(largest, (*norm)(result.state));
   // If a single step of a scheme of order n has the error e, two halves have
   // 2^-n e.
   const int n = Order(options.scheme);
   single -= result.state;
   single *= 1.0 / (std::pow(2.0, n) - 1.0);
   result.step.error = largest > 0.0 ? (*norm)(single) / largest : 0.0;
   result.step.order = n + 1;
   result.last_dt = 0.5 * dt;
   return true;
}

StepReport TimeStepper::Step()
{
   StopWatch watch;
   watch.Start();
   StepReport report;
   const int solves_before = recorder.Solves();
   if (goal <= time + same_time)
   {
      goal = time + PlannedLength(time);
   }
   control.Plan(PlannedLength(time));
   bool again = true;
   while (again)
   {
      const real_t target = Target();
      ReadOnHost(state);
      Attempt result(state);
      result.step.dt = report.dt = target - time;
      const int first_solve = recorder.Solves();
      op.BeginStep(state);
      report.converged = options.adaptive && !smooth
                            ? AdvanceInHalves(report.dt, result)
                            : Advance(report.dt, result);
      report.solve = op.Report();
      report.error = result.step.error;
      result.step.newton = static_cast<real_t>(report.solve.newton) /
                           std::max(1, recorder.Solves() - first_solve);
      if (!report.converged)
      {
         op.RejectStep();
         again = control.Fail(report.dt);
         report.failures++;
         report.last_failure = report.solve.reason;
         continue;
      }
      const StepControl::Verdict verdict = control.Judge(result.step);
      again = verdict == StepControl::Verdict::repeat;
      if (again)
      {
         op.RejectStep();
         report.rejections++;
      }
      else
      {
         Accept(result, target, verdict == StepControl::Verdict::accept_jump);
      }
   }
   if (!report.converged)
   {
      report.reason = report.solve.reason;
      if (options.cut_back)
      {
         report.reason += " (tried " + std::to_string(report.failures) +
                          " times; a step is not cut below min_step = " +
                          ToText(options.min_step) + ")";
      }
   }
   for (const ContactPair *pair : op.Pairs())
   {
      if (report.converged)
      {
         report.contact_area += ContactArea(*pair);
      }
   }
   report.time = time;
   report.solves = recorder.Solves() - solves_before;
   report.work = op.Work();
   report.work -= reported;
   reported += report.work;
   UpdateFields();
   report.seconds = watch.RealTime();
   return report;
}

void TimeStepper::Accept(const Attempt &result, real_t target, bool jump)
{
   const Stop &stop = NextStop(time);
   const bool stops_here = target == stop.time;
   const bool corner = stops_here && stop.corner;
   smooth = !jump && !corner;
   if (corner)
   {
      op.ForgetRate();
   }
   op.AcceptStep();
   subtract(1.0 / result.step.dt, result.state.GetBlock(0), state.GetBlock(0),
            velocity);
   ReadOnHost(state);
   ReadOnHost(result.state);
   state = result.state;
   state.SyncToBlocks();
   if (stops_here)
   {
      goal = target;
   }
   last_dt = result.last_dt;
   time = target;
   steps++;
   control.Grow(result.step);
}

void TimeStepper::BeginAnew()
{
   control = StepControl(Limits(options), op.Options().tuning.steps);
   goal = time;
   smooth = false;
   op.BeginAnew(time, state.GetBlock(0));
}

void TimeStepper::Archive(StateArchive &archive)
{
   archive.Number("time", time);
   archive.Count("steps", steps);
   archive.Number("step.goal", goal);
   archive.Flag("step.smooth", smooth);
   archive.Number("step.last", last_dt);
   archive.Number("step.largest_norm", largest);
   control.Plan(PlannedLength(time));
   control.Archive(archive);
   archive.Field("displacement", *displacement.ParFESpace(), state.GetBlock(0));
   archive.Field("pressure", *pressure.ParFESpace(), state.GetBlock(1));
   archive.Field("velocity", *displacement.ParFESpace(), velocity);
   op.Archive(archive);
   if (archive.Reads())
   {
      if (!control.IsCut())
      {
         // The step may have another length than it had.
         goal = time;
      }
      UpdateFields();
   }
}

void TimeStepper::UpdateFields()
{
   displacement.SetFromTrueDofs(state.GetBlock(0));
   pressure.SetFromTrueDofs(state.GetBlock(1));
   displacement.HostRead();
   pressure.HostRead();
   ReadOnHost(state);
}

} // namespace synovia
