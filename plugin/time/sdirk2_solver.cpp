#include "synovia/time/sdirk2_solver.hpp"

namespace synovia
{

using namespace mfem;

void Sdirk2Solver::Init(TimeDependentOperator &op)
{
   ODESolver::Init(op);
   first.SetSize(op.Width(), mem_type);
   second.SetSize(op.Width(), mem_type);
}

void Sdirk2Solver::Step(Vector &x, real_t &t, real_t &dt)
{
   f->SetTime(t + gamma * dt);
   f->ImplicitSolve(gamma * dt, x, first);
   x.Add((1.0 - gamma) * dt, first);
   f->SetTime(t + dt);
   f->ImplicitSolve(gamma * dt, x, second);
   x.Add(gamma * dt, second);
   t += dt;
}

} // namespace synovia
