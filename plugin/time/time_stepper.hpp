#pragma once

#include "synovia/physics/biphasic_problem.hpp"
#include "synovia/time/step_control.hpp"
#include "synovia/time/step_error.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace synovia
{

/// Times in the problem's unit; zero means: derived.
struct TimeOptions
{
   mfem::real_t end = 1.0;
   /// Length of the steps; of the first one to be tried if they are adaptive,
   /// of the first one and of those after corners of load curves if they grow.
   mfem::real_t step = 1.0;
   /// How much longer each step is than the one before it, 1 or more; up to
   /// max_step, and not for adaptive steps.
   mfem::real_t growth = 1.0;
   /// When the first of them begins.
   mfem::real_t begin = 0.0;
   TimeScheme scheme = TimeScheme::backward_euler;
   /// Chooses the length of each step such that it makes an error of about
   /// error_tolerance.
   bool adaptive = false;
   /// Error of one step in the energy norm of displacement and pressure, as a
   /// part of the largest norm that they have had so far.
   mfem::real_t error_tolerance = 5e-3;
   /// Whether a step that fails is tried again from where it began, with half
   /// the length.
   bool cut_back = true;
   /// A step of this length is not cut further: if its error is too large it is
   /// accepted, if it does not converge the run fails. Derived: step / 1000.
   mfem::real_t min_step = 0.0;
   /// Longest step that is adaptive or has grown. Derived: a tenth of the time
   /// between begin and end, or step if that is longer.
   mfem::real_t max_step = 0.0;
   /// Times at which a step shall end, besides the corners of load curves;
   /// those outside (0, end) don't matter.
   std::vector<mfem::real_t> stops;
};

/// How many steps last @a duration, from where they begin, if none fails; of
/// adaptive ones a guess. max_step must be given if they grow.
int CountSteps(const TimeOptions &options, mfem::real_t duration);

/// Result of one time step.
struct StepReport
{
   bool converged = false;
   std::string reason;
   mfem::real_t time = 0.0;
   mfem::real_t dt = 0.0;
   /// Of the last attempt.
   SolveReport solve;
   /// Attempts that did not converge, and attempts whose error was too large.
   int failures = 0;
   int rejections = 0;
   /// Why the last of the former failed.
   std::string last_failure;
   /// Implicit solves of all attempts.
   int solves = 0;
   /// Work of all attempts; that of the first step includes the work before
   /// it.
   WorkCounts work;
   /// Estimated error as error_tolerance has it; 0 where steps are fixed.
   mfem::real_t error = 0.0;
   /// Area in contact, of all pairs.
   mfem::real_t contact_area = 0.0;
   /// Wall time of the step (s).
   mfem::real_t seconds = 0.0;
};

/// Marches a problem in time with MFEM's ODE solvers.
///
/// Steps have the length asked for, grow from it or have one that adapts, and
/// end on the corners of the load curves, on the stops, and at the end. A step
/// that fails leaves everything as it was. After cut-backs, steps that aren't
/// adaptive get back to the times they would have had without.
///
/// The error of an adaptive step is estimated from the rates of its stages,
/// which needs no further solve. After a corner or a jump these are not smooth:
/// that step is made of two halves, and the error taken from the comparison
/// with a single step.
class TimeStepper
{
public:
   /// Borrows @a problem and assembles it if need be; the state starts at rest.
   /// Throws Error on options out of range. Collective.
   TimeStepper(BiphasicProblem &problem, const TimeOptions &options);

   /// Goes on as at the start, with the first step's length: what is prescribed
   /// has changed. Relative conditions since the present time count from the
   /// present state. Collective.
   void BeginAnew();

   /// One accepted step, with all the attempts that it takes, or a failed one.
   /// Collective. Undefined once Done().
   StepReport Step();
   bool Done() const;

   mfem::real_t Time() const { return time; }
   /// Accepted steps since the time 0.
   int Steps() const { return steps; }
   /// Displacement and pressure, true dofs.
   const mfem::BlockVector &State() const { return state; }
   /// Velocity of the solid, the mean over the last step; true dofs.
   const mfem::Vector &Velocity() const { return velocity; }
   /// Fields of the state; they follow each step.
   mfem::ParGridFunction &Displacement() { return displacement; }
   mfem::ParGridFunction &Pressure() { return pressure; }
   /// How many steps are left if none fails; with adaptive steps a guess, from
   /// the present length and the mean one.
   int StepsLeft() const;

   /// Lists all that the next step depends on, the problem's part included.
   /// Collective.
   void Archive(StateArchive &archive);

private:
   struct Stop
   {
      mfem::real_t time;
      bool corner;
   };
   /// A converged attempt.
   struct Attempt
   {
      explicit Attempt(const mfem::BlockVector &start) : state(start) {}
      mfem::BlockVector state;
      StepAttempt step;
      /// Length of its last part, from which the next rate stems.
      mfem::real_t last_dt = 0.0;
   };

   void SetStops(const std::vector<mfem::real_t> &corners);
   const Stop &NextStop(mfem::real_t from) const;
   /// Length of a step from that time on, unless it is adaptive or cut. Steps
   /// that grow by a factor are longer by a part of the time that has passed.
   mfem::real_t PlannedLength(mfem::real_t from) const;
   mfem::real_t Target() const;
   bool Advance(mfem::real_t dt, Attempt &result);
   bool AdvanceInHalves(mfem::real_t dt, Attempt &result);
   void Solve(mfem::real_t t, mfem::real_t dt, mfem::BlockVector &x);
   void Accept(const Attempt &result, mfem::real_t target, bool jump);
   void UpdateFields();

   BiphasicOperator &op;
   TimeOptions options;
   StageRecorder recorder;
   std::unique_ptr<mfem::ODESolver> solver;
   /// Of adaptive steps.
   std::optional<EnergyNorm> norm;
   StepControl control;
   /// Times that differ by less are the same.
   mfem::real_t same_time;
   std::vector<Stop> stops;
   mfem::real_t time = 0.0;
   /// Where the present step ends if it is not cut; not of adaptive ones.
   mfem::real_t goal = 0.0;
   int steps = 0;
   /// As far as it was reported.
   WorkCounts reported;
   mfem::BlockVector state;
   mfem::Vector velocity;
   /// Whether the rate at the end of the last step predicts the next one, and
   /// over what length it was found.
   bool smooth = false;
   mfem::real_t last_dt = 0.0;
   /// The largest norm of the state, over rejected attempts too.
   mfem::real_t largest = 0.0;
   mfem::ParGridFunction displacement;
   mfem::ParGridFunction pressure;
};

} // namespace synovia
