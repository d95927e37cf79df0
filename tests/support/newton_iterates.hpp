#pragma once

#include "support/temporary_directory.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/io/checkpoint.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <vector>

namespace synovia
{

/// Tuning with which Newton's method is nothing but Newton's method: each
/// iteration has a tangent of its own, solves for it exactly, closes the gaps
/// of contact, and keeps the partners of its points.
inline NonlinearOptions PlainNewton(int max_newton)
{
   NonlinearOptions options;
   options.max_newton = max_newton;
   options.active_set_tolerance = 0.0;
   options.linear.method = LinearMethod::direct;
   options.linear.relative_tolerance = 1e-12;
   NewtonTuning &newton = options.tuning.newton;
   newton.kept_tangent = 0.0;
   newton.multiplier_compliance = 1e-4;
   newton.max_early_searches = 0;
   newton.max_searches = 0;
   return options;
}

/// Where a step of backward Euler from where @a stepper is comes to. It is not
/// accepted; if Newton's method does not converge it is the last iterate.
/// Collective.
inline mfem::BlockVector TryStep(BiphasicProblem &problem,
                                 const TimeStepper &stepper, mfem::real_t dt)
{
   BiphasicOperator &op = problem.Operator();
   mfem::BlockVector state(stepper.State());
   mfem::Vector conserved;
   op.Equations().Bodies().GetConserved(state.GetBlock(0), conserved);
   mfem::Vector whole(op.Height());
   whole.SetVector(state, 0);
   whole.SetVector(conserved, state.Size());
   mfem::Vector rate;
   op.BeginStep(state);
   op.SetTime(stepper.Time() + dt);
   op.ImplicitSolve(dt, whole, rate);
   for (int i = 0; i < state.Size(); i++)
   {
      state[i] += dt * rate[i];
   }
   state.SyncToBlocks();
   return state;
}

/// Largest errors of displacement and pressure, as parts of the largest values,
/// of a step's first guess and after each iteration.
struct NewtonErrors
{
   std::vector<mfem::real_t> u;
   std::vector<mfem::real_t> p;
};

/// Of a step of length @a dt after the end of @a times. @a make makes, for a
/// number of iterations, a pointer to what has a problem with PlainNewton().
/// Collective.
template <typename Make>
NewtonErrors FindNewtonErrors(Make make, const TimeOptions &times,
                              mfem::real_t dt)
{
   constexpr int enough = 30;
   const auto model = make(enough);
   TimeStepper stepper(model->problem, times);
   while (!stepper.Done())
   {
      const StepReport report = stepper.Step();
      INFO(report.reason);
      REQUIRE(report.converged);
   }
   const TemporaryDirectory directory;
   const std::string file =
      WriteCheckpoint(directory.Path(), model->problem, stepper);
   const mfem::BlockVector exact = TryStep(model->problem, stepper, dt);
   const SolveReport &report = model->problem.Operator().Report();
   INFO(report.reason);
   REQUIRE(report.converged);
   const auto largest = [&](const mfem::Vector &x)
   {
      return MaxOverRanks(x.Size() > 0 ? x.Normlinf() : 0.0,
                          model->problem.Spaces().GetComm());
   };
   NewtonErrors errors;
   for (int iterations = 0; iterations <= report.newton; iterations++)
   {
      const auto other = make(iterations);
      TimeStepper begin(other->problem, times);
      ReadCheckpoint(file, other->problem, begin);
      mfem::BlockVector reached = TryStep(other->problem, begin, dt);
      for (int b = 0; b < 2; b++)
      {
         reached.GetBlock(b) -= exact.GetBlock(b);
         (b == 0 ? errors.u : errors.p)
            .push_back(largest(reached.GetBlock(b)) /
                       largest(exact.GetBlock(b)));
      }
   }
   return errors;
}

/// By how much the last iteration above round-off multiplies the number of
/// digits: 2 where Newton's method converges quadratically, and 1 + log(q) /
/// log(error) where linearly with the factor q.
inline mfem::real_t GrowthOfDigits(const std::vector<mfem::real_t> &errors)
{
   constexpr mfem::real_t round_off = 1e-12;
   std::size_t last = 0;
   while (last + 1 < errors.size() && errors[last + 1] > round_off)
   {
      last++;
   }
   // From larger ones linear convergence would get as far.
   constexpr mfem::real_t small = 5e-4;
   REQUIRE(last >= 1);
   REQUIRE(errors[last - 1] < small);
   return std::log(errors[last]) / std::log(errors[last - 1]);
}

} // namespace synovia
