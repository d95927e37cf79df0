#include "solvers/direct_preconditioner.hpp"
#include "solvers/direct_solver.hpp"

#include <algorithm>
#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
// Steps within this factor of the one factorised for still share its factors.
constexpr real_t like_step = 1.2;
// A weight that differs by more than this part is another one.
constexpr real_t other = 0.5;
} // namespace

DirectPreconditioner::DirectPreconditioner(const BiphasicJacobian &jacobian_,
                                           int renew_after_)
   : BiphasicPreconditioner(jacobian_.Height()), jacobian(jacobian_),
     renew_after(renew_after_)
{
}

int DirectPreconditioner::ChangedRows() const
{
   const auto differences = [](const Vector &a, const Vector &b)
   {
      int count = 0;
      for (int i = 0; i < a.Size(); i++)
      {
         count += std::abs(a[i] - b[i]) > other * std::max(a[i], b[i]);
      }
      return count;
   };
   int count = 0;
   for (size_t i = 0; i < gap_weights.size(); i++)
   {
      const ContactPair &pair = *jacobian.Pairs()[i];
      count += differences(gap_weights[i], pair.GapWeights());
      count += differences(jump_weights[i], pair.JumpWeights());
   }
   MPI_Allreduce(MPI_IN_PLACE, &count, 1, MPI_INT, MPI_SUM,
                 jacobian.Volume().darcy->GetComm());
   return count;
}

void DirectPreconditioner::Update()
{
   const real_t now = jacobian.TimeStep();
   const bool like = now <= like_step * dt && dt <= like_step * now;
   fresh = outdated || !like || ChangedRows() > renew_after / 2;
   if (!fresh)
   {
      return;
   }
   dt = now;
   gap_weights.clear();
   jump_weights.clear();
   for (const ContactPair *pair : jacobian.Pairs())
   {
      gap_weights.push_back(pair->GapWeights());
      jump_weights.push_back(pair->JumpWeights());
   }
   outdated = false;
   extra_iterations = 0;
   // The old factors go first: two at once would double the peak of memory.
   factors.reset();
   matrix = jacobian.Assemble();
   factors = MakeDirectSolver(*matrix, MatrixKind::symmetric);
}

bool DirectPreconditioner::Report(int iterations, bool converged)
{
   extra_iterations += std::max(0, iterations - 1);
   outdated = extra_iterations >= renew_after;
   return !converged && !fresh;
}

void DirectPreconditioner::Mult(const Vector &x, Vector &y) const
{
   factors->Mult(x, y);
}

} // namespace synovia
