// ranks: 1 2
//
// Adaptive steps in confined compression of a layer (height h, c = H_A kappa)
// by a porous platen that moves with V0 until t0 and stands then. The exact
// stress on the platen is s(t) - s(t - t0), with
//
//    s(t) = (H_A V0/h) {t + (h^2/c) [1/3 - (2/pi^2) sum n^-2
//                                          exp(-n^2 pi^2 c t/h^2)]}.
//
// Near the corners, at 0 and t0, it changes like the square root of time, at
// the end not at all: long steps everywhere miss the first, short ones
// everywhere waste work on the second.

#include "support/boxes.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t height = 0.75;
constexpr real_t side = 0.2;
constexpr real_t corner = 100.0;
constexpr real_t end = 1500.0;
constexpr real_t depth = 0.075;
constexpr real_t permeability = 4.0e-3;

const IsotropicElastic &Cartilage()
{
   static const IsotropicElastic law(0.5417, 0.0833);
   return law;
}

real_t RampStress(real_t t)
{
   const real_t modulus = Cartilage().AggregateModulus();
   const real_t gel_time = height * height / (modulus * permeability);
   const real_t speed = depth / corner;
   if (t <= 0.0)
   {
      return 0.0;
   }
   real_t sum = 0.0;
   for (int n = 2000; n >= 1; n--)
   {
      sum += std::exp(-n * n * M_PI * M_PI * t / gel_time) / (n * n);
   }
   return modulus * speed / height *
          (t + gel_time * (1.0 / 3.0 - 2.0 / (M_PI * M_PI) * sum));
}

real_t ExactStress(real_t t)
{
   return RampStress(t) - RampStress(t - corner);
}

struct Outcome
{
   int steps = 0;
   int solves = 0;
   int rejections = 0;
   bool on_corner = false;
   bool on_stop = false;
   real_t shortest = end;
   real_t longest = 0.0;
   real_t shortest_after_corner = end;
   /// Largest error of the stress, as a part of the largest stress.
   real_t error = 0.0;
};

constexpr real_t output_time = 333.0;

Outcome Compress(const TimeOptions &options)
{
   BoxOptions box;
   box.nx = 1;
   box.ny = 1;
   box.nz = 12;
   box.size_x = side;
   box.size_y = side;
   box.size_z = height;
   box.grading = 2.0;
   NamedMesh mesh = MakeBox(box);
   BiphasicProblem problem(mesh, SpaceOptions());
   const ConstantPermeability fluid(permeability);
   problem.SetMaterial("body", Cartilage(), fluid);
   problem.FixDisplacement("z0");
   for (const char *name : {"x0", "x1"})
   {
      problem.PrescribeDisplacement(name, 0, 0.0);
   }
   for (const char *name : {"y0", "y1"})
   {
      problem.PrescribeDisplacement(name, 1, 0.0);
   }
   problem.PrescribePressure("z1", 0.0);
   problem.PrescribeDisplacement("z1", 2, Ramp(corner, -depth));
   TimeStepper stepper(problem, options);
   Outcome outcome;
   real_t largest = 0.0;
   while (!stepper.Done())
   {
      const StepReport report = stepper.Step();
      REQUIRE(report.converged);
      outcome.steps++;
      outcome.solves += report.solves;
      outcome.rejections += report.rejections;
      outcome.on_corner = outcome.on_corner || report.time == corner;
      outcome.on_stop = outcome.on_stop || report.time == output_time;
      outcome.shortest = std::min(outcome.shortest, report.dt);
      outcome.longest = std::max(outcome.longest, report.dt);
      if (report.time > corner)
      {
         outcome.shortest_after_corner =
            std::min(outcome.shortest_after_corner, report.dt);
      }
      const real_t stress =
         -problem.Reaction(problem.Supports().back())[2] / (side * side);
      const real_t exact = ExactStress(report.time);
      largest = std::max(largest, exact);
      outcome.error = std::max(outcome.error, std::abs(stress - exact));
   }
   outcome.error /= largest;
   return outcome;
}
} // namespace

TEST_CASE("Adaptive steps reach the accuracy of fixed ones with half the work")
{
   TimeOptions options;
   options.scheme = GENERATE(TimeScheme::backward_euler, TimeScheme::sdirk23,
                             TimeScheme::sdirk33);
   options.end = end;
   options.step = 5.0;
   options.adaptive = true;
   options.stops = {output_time, -1.0, end};
   const Outcome adaptive = Compress(options);
   CHECK(adaptive.on_corner);
   CHECK(adaptive.on_stop);

   const int stages = Order(options.scheme);
   TimeOptions fixed;
   fixed.scheme = options.scheme;
   fixed.end = end;
   fixed.step = end * stages / (2.0 * adaptive.solves);
   const Outcome twice = Compress(fixed);
   CAPTURE(stages, adaptive.steps, adaptive.solves, adaptive.rejections,
           adaptive.error, twice.steps, twice.solves, twice.error,
           adaptive.shortest, adaptive.longest);
   CHECK(twice.solves >= 2 * adaptive.solves);
   CHECK(twice.error > adaptive.error);
   CHECK(adaptive.error < 0.03);
   // The step shrinks where the platen stops, and grows later.
   CHECK(adaptive.shortest_after_corner < 0.25 * adaptive.longest);
   CHECK(adaptive.longest == Approx(0.1 * end));
}

TEST_CASE("A smaller tolerance gives a smaller error")
{
   TimeOptions options;
   options.end = end;
   options.step = 5.0;
   options.adaptive = true;
   options.error_tolerance = 4e-2;
   const Outcome coarse = Compress(options);
   options.error_tolerance = 4e-3;
   const Outcome fine = Compress(options);
   CAPTURE(coarse.solves, fine.solves, coarse.error, fine.error);
   CHECK(fine.error < 0.5 * coarse.error);
   CHECK(fine.solves > coarse.solves);
}
