// ranks: 1

#include "synovia/time/sdirk2_solver.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
/// x' = stiffness (cos t - x) - sin t, of which cos t is a solution (Prothero &
/// Robinson).
class Relaxation : public TimeDependentOperator
{
public:
   explicit Relaxation(real_t stiffness_)
      : TimeDependentOperator(1, 0.0, IMPLICIT), stiffness(stiffness_)
   {
   }
   void ImplicitSolve(const real_t dt, const Vector &x, Vector &k) override
   {
      const real_t t = GetTime();
      k[0] = (stiffness * (std::cos(t) - x[0]) - std::sin(t)) /
             (1.0 + dt * stiffness);
      last_time = t;
      last_value = x[0] + dt * k[0];
   }

   real_t stiffness;
   /// Of the last stage.
   real_t last_time = 0.0;
   real_t last_value = 0.0;
};

real_t Error(real_t stiffness, int steps)
{
   Relaxation problem(stiffness);
   Sdirk2Solver solver;
   solver.Init(problem);
   Vector x(1);
   x = 1.0;
   real_t t = 0.0;
   real_t dt = 1.0 / steps;
   for (int i = 0; i < steps; i++)
   {
      solver.Step(x, t, dt);
      // Stiffly accurate: what is known of the last stage is known of the end.
      CHECK(problem.last_time == Approx(t));
      CHECK(problem.last_value == Approx(x[0]));
   }
   CHECK(t == Approx(1.0));
   return std::abs(x[0] - std::cos(1.0));
}
} // namespace

TEST_CASE("Two stages are of order two, and end where the step ends")
{
   CHECK(std::log2(Error(1.0, 20) / Error(1.0, 40)) == Approx(2.0).margin(0.1));
}

TEST_CASE("What is stiff dies in a step")
{
   Relaxation problem(1e9);
   Sdirk2Solver solver;
   solver.Init(problem);
   Vector x(1);
   x = 100.0;
   real_t t = 0.0;
   real_t dt = 0.1;
   solver.Step(x, t, dt);
   CHECK(x[0] == Approx(std::cos(0.1)).epsilon(1e-3));
}
