#include "synovia/linalg/biphasic_linear_solver.hpp"
#include "synovia/general/phase_timer.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/linalg/block_amg_preconditioner.hpp"
#include "synovia/linalg/bordered_preconditioner.hpp"
#include "synovia/linalg/direct_preconditioner.hpp"
#include "synovia/linalg/scaled_equations.hpp"

#include <algorithm>
#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
// Of the rows that have any; 1 if there are none.
real_t MeanDiagonal(const HypreParMatrix &matrix)
{
   Vector diagonal(matrix.Height());
   matrix.GetDiag(diagonal);
   diagonal.HostRead();
   const real_t rows = static_cast<real_t>(
      std::count_if(diagonal.begin(), diagonal.end(),
                    [](real_t entry) { return entry != 0.0; }));
   const real_t all = SumOverRanks(rows, matrix.GetComm());
   return all > 0.0 ? SumOverRanks(diagonal.Sum(), matrix.GetComm()) / all
                    : 1.0;
}
} // namespace

LinearMethod ChooseMethod(const LinearOptions &options, HYPRE_BigInt dofs,
                          bool has_fibers)
{
   if (options.method != LinearMethod::automatic)
   {
      return options.method;
   }
   const HYPRE_BigInt most =
      has_fibers ? options.direct_below_with_fibers : options.direct_below;
   return dofs <= most ? LinearMethod::direct : LinearMethod::block_amg;
}

SolveAttempt Attempt(const BiphasicPreconditioner &preconditioner, int most,
                     const Vector &b, real_t target, FGMRESSolver &solver,
                     Vector &x)
{
   // FGMRES follows its residual by recurrences, which leave the true one where
   // a preconditioner makes vectors much larger.
   constexpr real_t most_drift = 2.0;
   // Stiff penalties may keep a residual above that by round-off.
   constexpr real_t round_off = 1e-8;
   const int patience = std::min(preconditioner.Patience(), most);
   solver.SetRelTol(0.0);
   solver.SetAbsTol(target);
   solver.SetMaxIter(patience);
   solver.Mult(b, x);
   const real_t initial_norm = solver.GetInitialNorm();
   int iterations = solver.GetNumIterations();
   SolveAttempt attempt;
   attempt.iterations = iterations;
   solver.iterative_mode = true;
   solver.SetAbsTol(std::max(most_drift * target, round_off * initial_norm));
   while (solver.GetConverged() && iterations > 0)
   {
      solver.SetMaxIter(patience - attempt.iterations);
      solver.Mult(b, x);
      iterations = solver.GetNumIterations();
      attempt.iterations += iterations;
   }
   attempt.converged = solver.GetConverged();
   attempt.reduction = solver.GetFinalNorm() / initial_norm;
   return attempt;
}

BiphasicLinearSolver::BiphasicLinearSolver(const BiphasicJacobian &jacobian_,
                                           BiphasicSpaces &spaces,
                                           const LinearOptions &options_,
                                           const SolverTuning &tuning_)
   : jacobian(jacobian_), comm(spaces.GetComm()), options(options_),
     tuning(tuning_),
     force_per_volume(std::sqrt(MeanDiagonal(*jacobian.Volume().stiffness) /
                                MeanDiagonal(*jacobian.Volume().compliance)))
{
   const HYPRE_BigInt dofs = spaces.Displacement().GlobalTrueVSize() +
                             spaces.Pressure().GlobalTrueVSize();
   const bool is_anisotropic =
      jacobian.Volume().moduli.anisotropy > tuning.multigrid.smooth_anisotropy;
   options.method = ChooseMethod(options, dofs, is_anisotropic);
   if (options.method == LinearMethod::direct || !jacobian.Contact().empty() ||
       is_anisotropic)
   {
      VerifyDirectLibrary(options.direct.library, comm);
   }
   preconditioner = MakePreconditioner();
}

BiphasicLinearSolver::~BiphasicLinearSolver() = default;

std::unique_ptr<BiphasicPreconditioner>
BiphasicLinearSolver::MakePreconditioner() const
{
   std::unique_ptr<BiphasicPreconditioner> made;
   if (options.method == LinearMethod::direct)
   {
      made = std::make_unique<DirectPreconditioner>(
         jacobian, comm, options.renew_after, options.direct,
         tuning.factorization);
   }
   else
   {
      DirectOptions exact(options.direct);
      exact.single_precision = tuning.factorization.single_precision;
      made = std::make_unique<BlockAmgPreconditioner>(jacobian, comm, exact,
                                                      tuning.multigrid);
      if (jacobian.Ties())
      {
         made = std::make_unique<BorderedPreconditioner>(
            jacobian, comm, force_per_volume, std::move(made));
      }
   }
   return made;
}

WorkCounts BiphasicLinearSolver::Work() const
{
   WorkCounts all(work_before);
   all += preconditioner->Work();
   return all;
}

real_t BiphasicLinearSolver::Norm(const Vector &residual,
                                  const ResidualTolerance &tolerance) const
{
   residual.HostRead();
   real_t sum = 0.0;
   for (int i = 0; i < residual.Size(); i++)
   {
      const real_t part =
         residual[i] /
         (i < jacobian.Offsets()[1] ? tolerance.momentum : tolerance.mass);
      sum += part * part;
   }
   return std::sqrt(SumOverRanks(sum, comm));
}

BiphasicLinearSolver::Result
BiphasicLinearSolver::Solve(const Vector &b, Vector &x,
                            const ResidualTolerance &tolerance, real_t target,
                            FirstGuess guess)
{
   // In the scaled unknowns both equations have the tolerance of the momentum.
   const real_t pressure_scale = tolerance.momentum / tolerance.mass;
   const int pressure_begin = jacobian.Offsets()[1];
   const ScaledOperator2x2 scaled(jacobian, pressure_begin, pressure_scale);
   Vector right_side(b);
   ScaleFrom(pressure_begin, pressure_scale, right_side);
   if (guess == FirstGuess::given)
   {
      ScaleFrom(pressure_begin, 1.0 / pressure_scale, x);
   }
   const Result result = TryIterations(
      [&]
      {
         ScaledSolver scaled_preconditioner(*preconditioner, pressure_begin,
                                            1.0 / pressure_scale);
         return Iterate(scaled, scaled_preconditioner, right_side, x,
                        target * tolerance.momentum, guess);
      });
   ScaleFrom(pressure_begin, pressure_scale, x);
   // Contact and loads are evaluated on the host.
   x.HostReadWrite();
   return result;
}

BiphasicLinearSolver::Result
BiphasicLinearSolver::Solve(const Vector &b, Vector &x,
                            MultiplierChanges &changes, real_t compliance,
                            const ResidualTolerance &tolerance, real_t target)
{
   const MultiplierSystem system(jacobian, tolerance.momentum / tolerance.mass,
                                 compliance);
   const Vector right_side = system.RightSide(b);
   Vector solution(right_side.Size());
   const Result result = TryIterations(
      [&]
      {
         MultiplierPreconditioner system_preconditioner(system,
                                                        *preconditioner);
         return Iterate(system, system_preconditioner, right_side, solution,
                        target * tolerance.momentum, FirstGuess::zero);
      });
   system.Unpack(solution, x, changes);
   return result;
}

BiphasicLinearSolver::Result
BiphasicLinearSolver::TryIterations(const std::function<Result()> &iterate)
{
   try
   {
      return iterate();
   }
   catch (const FactorizationError &error) // on all ranks alike
   {
      work_before += preconditioner->Work();
      preconditioner.reset();
      preconditioner = MakePreconditioner();
      Result result;
      result.failure = error.what();
      return result;
   }
}

real_t BiphasicLinearSolver::ResidualNorm(const Operator &system,
                                          const Vector &right_side,
                                          const Vector &x) const
{
   Vector residual(right_side);
   system.AddMult(x, residual, -1.0);
   return std::sqrt(InnerProduct(comm, residual, residual));
}

BiphasicLinearSolver::Result BiphasicLinearSolver::Iterate(
   const Operator &system, Solver &system_preconditioner,
   const Vector &right_side, Vector &x, real_t target, FirstGuess guess)
{
   FGMRESSolver solver(comm);
   solver.SetKDim(tuning.multigrid.restart);
   solver.SetPrintLevel(IterativeSolver::PrintLevel().None());
   solver.SetOperator(system);
   solver.SetPreconditioner(system_preconditioner);

   if (guess == FirstGuess::zero)
   {
      x = 0.0;
   }
   Result result;
   if (guess == FirstGuess::given &&
       ResidualNorm(system, right_side, x) <= target)
   {
      // Without a preconditioner, which may take most of the time.
      result.converged = true;
      return result;
   }
   bool again = true;
   while (again && !result.converged &&
          result.iterations < options.max_iterations)
   {
      {
         const PhaseTimer timer(result.setup_seconds, "setup");
         preconditioner->Update();
      }
      // A guess of zero need not be multiplied.
      solver.iterative_mode =
         guess == FirstGuess::given || result.iterations > 0;
      const SolveAttempt attempt =
         Attempt(*preconditioner, options.max_iterations - result.iterations,
                 right_side, target, solver, x);
      result.converged = attempt.converged;
      result.iterations += attempt.iterations;
      result.decades -= std::log10(attempt.reduction);
      again = preconditioner->Report(attempt);
   }
   return result;
}

} // namespace synovia
