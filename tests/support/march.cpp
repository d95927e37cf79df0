#include "support/march.hpp"

namespace synovia
{

using namespace mfem;

March::March(BiphasicProblem &problem)
   : op(problem.Operator()), state(problem.Spaces().Offsets()),
     displacement(&problem.Spaces().Displacement()),
     pressure(&problem.Spaces().Pressure())
{
   state = 0.0;
   displacement = 0.0;
   pressure = 0.0;
}

bool March::Step(ODESolver &solver, real_t dt)
{
   solver.Init(op);
   op.BeginStep(state);
   solver.Step(state, time, dt);
   const bool converged = op.Report().converged;
   if (converged)
   {
      op.AcceptStep();
   }
   displacement.SetFromTrueDofs(state.GetBlock(0));
   pressure.SetFromTrueDofs(state.GetBlock(1));
   return converged;
}

} // namespace synovia
