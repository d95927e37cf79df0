// ranks: 1 2 3
//
// When FGMRES has solved a system, whatever its preconditioner does.

#include "synovia/linalg/biphasic_linear_solver.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr int size = 30;

/// A diagonal with entries from 1 to 2 on each rank.
class Diagonal : public Operator
{
public:
   Diagonal() : Operator(size) {}
   void Mult(const Vector &x, Vector &y) const override
   {
      y.SetSize(size);
      for (int i = 0; i < size; i++)
      {
         y[i] = (1.0 + i / real_t(size)) * x[i];
      }
   }
};

/// Adds to each vector its mean, so many times.
class GrowingPreconditioner : public BiphasicPreconditioner
{
public:
   GrowingPreconditioner(real_t growth_, int patience_)
      : BiphasicPreconditioner(size), growth(growth_), patience(patience_)
   {
   }
   void ContactMoved() override {}
   void TangentChanged() override {}
   void ContactFollowed() override {}
   void Update() override {}
   bool Report(const SolveAttempt &) override { return false; }
   int Patience() const override { return patience; }
   void Mult(const Vector &x, Vector &y) const override
   {
      const real_t mean = x.Sum() / size;
      y = x;
      for (int i = 0; i < size; i++)
      {
         y[i] += growth * mean;
      }
   }

private:
   real_t growth;
   int patience;
};

real_t Residual(const Operator &system, const Vector &b, const Vector &x)
{
   Vector r(size);
   system.Mult(x, r);
   r -= b;
   return std::sqrt(InnerProduct(MPI_COMM_WORLD, r, r));
}

constexpr real_t target = 1e-6;

struct Outcome
{
   SolveAttempt attempt;
   /// Norm of b - A x.
   real_t residual = 0.0;
   /// The same where FGMRES' own estimate reached the target.
   real_t residual_of_estimate = 0.0;
};

Outcome Solve(real_t growth, int patience)
{
   const Diagonal system;
   GrowingPreconditioner preconditioner(growth, patience);
   FGMRESSolver solver(MPI_COMM_WORLD);
   solver.SetPrintLevel(IterativeSolver::PrintLevel().None());
   solver.SetKDim(100);
   solver.SetOperator(system);
   solver.SetPreconditioner(preconditioner);
   Vector b(size);
   for (int i = 0; i < size; i++)
   {
      b[i] = std::sin(1.0 + i);
   }
   Vector x(size);
   solver.iterative_mode = false;
   solver.SetRelTol(0.0);
   solver.SetAbsTol(target);
   solver.SetMaxIter(100);
   solver.Mult(b, x);
   REQUIRE(solver.GetConverged());
   REQUIRE(solver.GetFinalNorm() <= target);

   Outcome outcome;
   outcome.residual_of_estimate = Residual(system, b, x);
   solver.iterative_mode = false;
   outcome.attempt = Attempt(preconditioner, 100, b, target, solver, x);
   outcome.residual = Residual(system, b, x);
   return outcome;
}
} // namespace

TEST_CASE("A system is solved when its residual is small, not an estimate")
{
   const int no_limit = std::numeric_limits<int>::max();
   const Outcome tame = Solve(0.0, no_limit);
   CHECK(tame.residual_of_estimate <= 2.0 * target);
   CHECK(tame.attempt.converged);
   CHECK(tame.residual <= 2.0 * target);

   const Outcome wild = Solve(1e13, no_limit);
   CHECK(wild.residual_of_estimate > 100.0 * target);
   CHECK(wild.attempt.converged);
   CHECK(wild.residual <= 2.0 * target);
   CHECK(wild.attempt.iterations > tame.attempt.iterations);
   CHECK(wild.attempt.reduction < 1e-6);

   // Enough for the estimate.
   const int patience = tame.attempt.iterations + 2;
   const Outcome given_up = Solve(1e13, patience);
   CHECK_FALSE(given_up.attempt.converged);
   CHECK(given_up.attempt.iterations <= patience);
   CHECK(given_up.residual > 2.0 * target);
}
