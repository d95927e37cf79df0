#include "solvers/time_stepper.hpp"
#include "general/error.hpp"
#include "general/text.hpp"

#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
// Steps shorter than this part of the wanted one are merged with the one
// before.
constexpr real_t shortest_step = 1e-6;

std::unique_ptr<ODESolver> MakeSolver(TimeScheme scheme)
{
   switch (scheme)
   {
   case TimeScheme::sdirk23:
      // The variant with gamma = 1 - 1/sqrt(2), which is L-stable.
      return std::make_unique<SDIRK23Solver>(2);
   case TimeScheme::sdirk33:
      return std::make_unique<SDIRK33Solver>();
   default:
      return std::make_unique<BackwardEulerSolver>();
   }
}

TimeOptions Checked(const TimeOptions &options)
{
   if (!(options.step > 0.0))
   {
      throw Error("the time step is " + ToText(options.step) +
                  "; it must be positive");
   }
   if (!(options.end > 0.0))
   {
      throw Error("the end time is " + ToText(options.end) +
                  "; it must be positive");
   }
   return options;
}
} // namespace

TimeStepper::TimeStepper(BiphasicProblem &problem, const TimeOptions &options_)
   : op(problem.Operator()), options(Checked(options_)),
     solver(MakeSolver(options.scheme)), state(problem.Spaces().Offsets()),
     displacement(&problem.Spaces().Displacement()),
     pressure(&problem.Spaces().Pressure())
{
   for (const real_t corner : problem.Conditions().Corners())
   {
      if (corner > 0.0 && corner < options.end)
      {
         stops.push_back(corner);
      }
   }
   stops.push_back(options.end);
   state = 0.0;
   velocity.SetSize(state.GetBlock(0).Size());
   velocity = 0.0;
   solver->Init(op);
   UpdateFields();
}

bool TimeStepper::Done() const
{
   return time >= options.end - shortest_step * options.step;
}

real_t TimeStepper::NextTime(real_t from) const
{
   real_t stop = options.end;
   for (const real_t candidate : stops)
   {
      if (candidate > from + shortest_step * options.step)
      {
         stop = candidate;
         break;
      }
   }
   const real_t next = from + options.step;
   return next > stop - shortest_step * options.step ? stop : next;
}

int TimeStepper::StepsLeft() const
{
   int steps = 0;
   for (real_t t = time; t < options.end - shortest_step * options.step;
        t = NextTime(t))
   {
      steps++;
   }
   return steps;
}

StepReport TimeStepper::Step()
{
   StopWatch watch;
   watch.Start();
   StepReport report;
   const real_t target = NextTime(time);
   const BlockVector before(state);
   real_t t = time;
   real_t dt = target - time;
   op.BeginStep();
   solver->Step(state, t, dt);
   report.solve = op.Report();
   report.converged = report.solve.converged;
   report.reason = report.solve.reason;
   report.dt = dt;
   if (report.converged)
   {
      op.AcceptStep();
      subtract(1.0 / dt, state.GetBlock(0), before.GetBlock(0), velocity);
      time = target;
   }
   else
   {
      op.RejectStep();
      state = before;
   }
   report.time = time;
   UpdateFields();
   report.seconds = watch.RealTime();
   return report;
}

void TimeStepper::UpdateFields()
{
   displacement.SetFromTrueDofs(state.GetBlock(0));
   pressure.SetFromTrueDofs(state.GetBlock(1));
}

} // namespace synovia
