#include "synovia/time/step_error.hpp"
#include "synovia/time/sdirk2_solver.hpp"

#include <algorithm>
#include <cmath>

namespace synovia
{

using namespace mfem;

int Order(TimeScheme scheme)
{
   switch (scheme)
   {
   case TimeScheme::sdirk23:
      return 2;
   case TimeScheme::sdirk33:
      return 3;
   default:
      return 1;
   }
}

int EstimateOrder(TimeScheme scheme)
{
   return scheme == TimeScheme::sdirk33 ? 3 : 2;
}

EnergyNorm::EnergyNorm(const VolumeMatrices &matrices,
                       const Array<int> &offsets_)
   : stiffness(matrices.stiffness), compliance(matrices.compliance),
     offsets(offsets_)
{
}

real_t EnergyNorm::operator()(const Vector &x) const
{
   const BlockVector state(const_cast<Vector &>(x), offsets);
   const Vector &u = state.GetBlock(0);
   const Vector &p = state.GetBlock(1);
   Vector force(u.Size());
   Vector volume(p.Size());
   stiffness->Mult(u, force);
   compliance->Mult(p, volume);
   MPI_Comm comm = stiffness->GetComm();
   const real_t energy =
      InnerProduct(comm, u, force) + InnerProduct(comm, p, volume);
   // Round-off can make that of a rigid motion negative.
   return std::sqrt(std::max(energy, real_t(0.0)));
}

Vector EstimateError(TimeScheme scheme, const StageRecorder &stages, real_t dt,
                     const PastRate &past)
{
   const int last = stages.Stages() - 1;
   Vector error(stages.Rate(last));
   if (scheme == TimeScheme::backward_euler)
   {
      // What else is conserved has no past rate.
      error.SetSize(past.rate.Size());
      error -= past.rate;
      error *= dt * dt / (dt + past.dt);
   }
   else if (scheme == TimeScheme::sdirk23)
   {
      // Weights (1-g, g) against (1, 0).
      error -= stages.Rate(last - 1);
      error *= Sdirk2Solver::gamma * dt;
   }
   else
   {
      // Weights (b, 1-a-b, a) against those of order two with none on the last
      // stage: the difference is a (1, -2, 1).
      constexpr real_t a = 0.435866521508458999;
      error.Add(-2.0, stages.Rate(last - 1));
      error += stages.Rate(last - 2);
      error *= a * dt;
   }
   return error;
}

} // namespace synovia
