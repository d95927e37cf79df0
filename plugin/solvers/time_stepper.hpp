#pragma once

#include "physics/biphasic_problem.hpp"

#include <memory>
#include <string>
#include <vector>

namespace synovia
{

/// Schemes that are stiffly accurate or at least L-stable.
enum class TimeScheme
{
   backward_euler,
   sdirk23,
   sdirk33
};

struct TimeOptions
{
   mfem::real_t end = 1.0;
   mfem::real_t step = 1.0;
   TimeScheme scheme = TimeScheme::backward_euler;
};

/// What one step came to.
struct StepReport
{
   bool converged = false;
   std::string reason;
   mfem::real_t time = 0.0;
   mfem::real_t dt = 0.0;
   SolveReport solve;
   /// Wall time of the step (s).
   mfem::real_t seconds = 0.0;
};

/// Marches a problem in time with MFEM's ODE solvers.
///
/// Steps have the length asked for, but end on the corners of the load curves
/// and at the end. A step that fails leaves the state as it was.
class TimeStepper
{
public:
   /// Borrows @a problem and assembles it if need be; the state starts at rest.
   /// Throws Error unless step and end are positive. Collective.
   TimeStepper(BiphasicProblem &problem, const TimeOptions &options);

   /// Collective. Undefined once Done().
   StepReport Step();
   bool Done() const;

   mfem::real_t Time() const { return time; }
   /// Displacement and pressure, true dofs.
   const mfem::BlockVector &State() const { return state; }
   /// Velocity of the solid, the mean over the last step; true dofs.
   const mfem::Vector &Velocity() const { return velocity; }
   /// Fields of the state; they follow each step.
   mfem::ParGridFunction &Displacement() { return displacement; }
   mfem::ParGridFunction &Pressure() { return pressure; }
   /// How many steps are left if none fails.
   int StepsLeft() const;

private:
   mfem::real_t NextTime(mfem::real_t from) const;
   void UpdateFields();

   BiphasicOperator &op;
   TimeOptions options;
   std::unique_ptr<mfem::ODESolver> solver;
   std::vector<mfem::real_t> stops;
   mfem::real_t time = 0.0;
   mfem::BlockVector state;
   mfem::Vector velocity;
   mfem::ParGridFunction displacement;
   mfem::ParGridFunction pressure;
};

} // namespace synovia
