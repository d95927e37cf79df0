#pragma once

#include "synovia/general/solver_tuning.hpp"
#include "synovia/linalg/biphasic_jacobian.hpp"
#include "synovia/linalg/direct_solver.hpp"
#include "synovia/linalg/multiplier_system.hpp"
#include "synovia/linalg/work_counts.hpp"

#include <algorithm>
#include <functional>

namespace synovia
{

/// How the linear systems are preconditioned.
enum class LinearMethod
{
   /// Direct for small problems, multigrid for large ones.
   automatic,
   /// Block-triangular: filtered BoomerAMG on the displacement, BoomerAMG on
   /// the pressure's Schur complement.
   block_amg,
   /// A factorization of the whole matrix, kept while it serves.
   direct
};

struct LinearOptions
{
   LinearMethod method = LinearMethod::automatic;
   mfem::real_t relative_tolerance = 1e-8;
   int max_iterations = 300;
   /// Automatic: up to this many dofs, direct.
   HYPRE_BigInt direct_below = 250000;
   /// The same where bodies have fibers (MultigridTuning::smooth_anisotropy),
   /// which are a part of what there is to factorize with multigrid, too.
   HYPRE_BigInt direct_below_with_fibers = 150000;
   /// A kept factorization is renewed once its solves have taken this many
   /// iterations more than a new one would have taken: about the cost of a
   /// factorization.
   int renew_after = 40;
   /// How matrices are factorized: the whole one, or, with multigrid, the part
   /// that contact touches.
   DirectOptions direct;
};

/// The method that automatic stands for with so many dofs of all ranks, and
/// with fibers or not; others stand for themselves.
LinearMethod ChooseMethod(const LinearOptions &options, HYPRE_BigInt dofs,
                          bool has_fibers);

/// One attempt to solve a system.
struct SolveAttempt
{
   int iterations = 0;
   bool converged = false;
   /// Norm of the residual over the initial one.
   mfem::real_t reduction = 1.0;
};

/// An approximate inverse of the Jacobian that follows its changes.
class BiphasicPreconditioner : public mfem::Solver
{
public:
   using mfem::Solver::Solver;
   /// Surfaces were searched anew: the gap and jump operators have other
   /// entries. Collective.
   virtual void ContactMoved() = 0;
   /// The matrices of bodies or contact have other values, a little later in
   /// the deformation; factors and hierarchies may stay in use. Collective.
   virtual void TangentChanged() = 0;
   /// The contact's operators have other values, as its points have moved on,
   /// while the tangents were kept. Collective.
   virtual void ContactFollowed() = 0;
   /// Called before each solve, when step, active set or drained dofs may have
   /// changed. Throws FactorizationError, as Mult() does; the preconditioner
   /// cannot be used any more then. Collective.
   virtual void Update() = 0;
   /// Called after each attempt; says whether another one, from where it ended,
   /// is worthwhile if it did not converge. Collective.
   virtual bool Report(const SolveAttempt &attempt) = 0;
   /// Most iterations of an attempt.
   virtual int Patience() const = 0;
   /// Setups, factorizations and columns since the start.
   const WorkCounts &Work() const { return work; }
   void SetOperator(const mfem::Operator &) override
   {
      MFEM_ABORT("the preconditioner keeps its operator");
   }

protected:
   WorkCounts work;
};

/// Runs @a solver for @a b, from @a x in its iterative mode and else from zero,
/// as long as @a preconditioner, which is inside it, has patience, but no
/// longer than @a most iterations. It has converged if FGMRES' estimate of the
/// norm of b - A x is at most @a target, and the norm itself at most twice that
/// or 1e-8 of what it was at first. Leaves @a solver in iterative mode.
/// Collective.
SolveAttempt Attempt(const BiphasicPreconditioner &preconditioner, int most,
                     const mfem::Vector &b, mfem::real_t target,
                     mfem::FGMRESSolver &solver, mfem::Vector &x);

/// Largest residual of each equation, as norms of true-dof vectors: force, and
/// volume of fluid in a step.
struct ResidualTolerance
{
   mfem::real_t momentum = 0.0;
   mfem::real_t mass = 0.0;
   /// Lower bound for the tolerance of the mass.
   mfem::real_t least_mass = 0.0;
   /// That of the mass before it was tightened.
   mfem::real_t untightened_mass = 0.0;

   /// What it was before the mass was tightened: residuals that are measured by
   /// it before and after compare.
   ResidualTolerance Untightened() const
   {
      ResidualTolerance untightened(*this);
      untightened.mass = std::max(mass, untightened_mass);
      return untightened;
   }
};

/// Where the iterations of a linear solve begin: at zero, or at the solution
/// that is given.
enum class FirstGuess
{
   zero,
   given
};

/// FGMRES with one of the preconditioners. Each equation is measured by its own
/// tolerance, so that the stopping test is the same in every system of units
/// and a stiff body's round-off doesn't hide the fluid.
class BiphasicLinearSolver
{
public:
   /// Borrows @a jacobian and @a spaces. Throws Error if the library that shall
   /// factorize can't. Collective.
   BiphasicLinearSolver(const BiphasicJacobian &jacobian,
                        BiphasicSpaces &spaces, const LinearOptions &options,
                        const SolverTuning &tuning = SolverTuning());
   ~BiphasicLinearSolver();

   void ContactMoved() { preconditioner->ContactMoved(); }
   void TangentChanged() { preconditioner->TangentChanged(); }
   void ContactFollowed() { preconditioner->ContactFollowed(); }

   /// Norm of a residual in units of the tolerance: at most 1 is good enough.
   /// Collective.
   mfem::real_t Norm(const mfem::Vector &residual,
                     const ResidualTolerance &tolerance) const;

   /// Scale of the momentum's residuals over the mass's (force / volume), for
   /// cases where one of the equations has no scale of its own.
   mfem::real_t ForcePerVolume() const { return force_per_volume; }

   struct Result
   {
      bool converged = false;
      int iterations = 0;
      /// Decimal logarithm of how far the residual fell.
      mfem::real_t decades = 0.0;
      /// Wall time to bring the preconditioner up to date (s).
      mfem::real_t setup_seconds = 0.0;
      /// Why the system could not be solved at all; empty if it could. The next
      /// one starts with a new preconditioner.
      std::string failure;
   };
   /// Solves J x = b, from zero or from the @a x that is given, until the
   /// Norm() of the residual is at most @a target. Collective.
   Result Solve(const mfem::Vector &b, mfem::Vector &x,
                const ResidualTolerance &tolerance, mfem::real_t target,
                FirstGuess guess = FirstGuess::zero);

   /// The same with the multipliers of contact as unknowns, whose @a changes
   /// are not those that the penalties make: see MultiplierSystem, with
   /// @a compliance. Collective.
   Result Solve(const mfem::Vector &b, mfem::Vector &x,
                MultiplierChanges &changes, mfem::real_t compliance,
                const ResidualTolerance &tolerance, mfem::real_t target);

   /// Those given, with the method that was chosen.
   const LinearOptions &Options() const { return options; }
   /// Work of the preconditioners since the start.
   WorkCounts Work() const;

private:
   std::unique_ptr<BiphasicPreconditioner> MakePreconditioner() const;
   /// Calls @a iterate, and says why if a factorization fails.
   Result TryIterations(const std::function<Result()> &iterate);
   mfem::real_t ResidualNorm(const mfem::Operator &system,
                             const mfem::Vector &right_side,
                             const mfem::Vector &x) const;
   /// Solves @a system to @a target.
   Result Iterate(const mfem::Operator &system,
                  mfem::Solver &system_preconditioner,
                  const mfem::Vector &right_side, mfem::Vector &x,
                  mfem::real_t target, FirstGuess guess);

   const BiphasicJacobian &jacobian;
   MPI_Comm comm;
   LinearOptions options;
   SolverTuning tuning;
   mfem::real_t force_per_volume;
   std::unique_ptr<BiphasicPreconditioner> preconditioner;
   /// Of preconditioners that failed.
   WorkCounts work_before;
};

} // namespace synovia
