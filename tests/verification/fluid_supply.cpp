// ranks: 1 2
//
// Vessels let fluid into a confined column of height h, kp (pc - p) per volume
// as it is deformed.
//
//     drained through its free top, at rest, infinitesimal:
//        kappa p'' + kp (pc - p) = 0, p'(0) = 0, p(h) = 0, so that
//        p = pc (1 - cosh(z/L)/cosh(h/L)), L = sqrt(kappa/kp); the stress of
//        the solid is p, and the top rises by (pc/H)(h - L tanh(h/L));
//     sealed, with a free top, infinitesimal: the strain e = p/H is
//        (pc/H)(1 - exp(-kp H t));
//     the same in finite deformation: dJ/dt = J kp (pc - s(J)), with the stress
//        s(J) of the confined solid, integrated by Runge and Kutta's method.

#include "support/boxes.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t height = 2.0;
constexpr real_t kappa = 4e-3;
constexpr real_t kp = 2e-3;
constexpr real_t E = 0.5;
constexpr real_t nu = 0.1;

real_t AggregateModulus()
{
   return E * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu));
}

/// A column of cross-section 0.3 x 0.3.
struct Column
{
   Column(bool finite, bool drained, real_t pc, int order, int cells)
      : mesh(Make(cells)), problem(mesh, Space(finite, order))
   {
      Material material;
      material.solid =
         finite ? static_cast<const SolidLaw *>(&deforming) : &linear;
      material.permeability = &permeability;
      material.supply = {kp, pc};
      problem.SetMaterial("body", material);
      problem.PrescribeDisplacement("z0", 2, 0.0);
      for (const char *name : {"x0", "x1"})
      {
         problem.PrescribeDisplacement(name, 0, 0.0);
      }
      for (const char *name : {"y0", "y1"})
      {
         problem.PrescribeDisplacement(name, 1, 0.0);
      }
      if (drained)
      {
         problem.PrescribePressure("z1", 0.0);
      }
   }

   static NamedMesh Make(int cells)
   {
      BoxOptions box;
      box.nz = cells;
      box.size_x = box.size_y = 0.3;
      box.size_z = height;
      return MakeBox(box);
   }
   static SpaceOptions Space(bool finite, int order)
   {
      SpaceOptions space;
      space.order = order;
      space.deformation =
         finite ? Deformation::finite : Deformation::infinitesimal;
      return space;
   }

   /// Runs to the end; gives the largest displacement and pressure.
   std::pair<real_t, real_t> Run(const TimeOptions &times)
   {
      TimeStepper stepper(problem, times);
      while (!stepper.Done())
      {
         const StepReport report = stepper.Step();
         INFO(report.reason);
         REQUIRE(report.converged);
         most_newton = std::max(most_newton, report.solve.newton);
      }
      const auto largest = [](const Vector &x) {
         return MaxOverRanks(x.Size() > 0 ? x.Normlinf() : 0.0, MPI_COMM_WORLD);
      };
      return {largest(stepper.State().GetBlock(0)),
              largest(stepper.State().GetBlock(1))};
   }

   IsotropicElastic linear{E, nu};
   NeoHookean deforming{E, nu};
   ConstantPermeability permeability{kappa};
   NamedMesh mesh;
   BiphasicProblem problem;
   int most_newton = 0;
};

/// Stress of the confined solid along the column.
real_t Stress(const NeoHookean &solid, real_t J)
{
   IsoparametricTransformation trans;
   const IntegrationPoint ip{};
   const Tensor3<> F{{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, J}}};
   Tensor3<> P;
   REQUIRE(solid.GetStress({trans, ip}, F, P, nullptr));
   return P[2][2];
}

real_t StretchAfter(real_t time, real_t pc)
{
   const NeoHookean solid(E, nu);
   const auto rate = [&](real_t J) { return J * kp * (pc - Stress(solid, J)); };
   constexpr int steps = 1000;
   const real_t h = time / steps;
   real_t J = 1.0;
   for (int i = 0; i < steps; i++)
   {
      const real_t a = rate(J);
      const real_t b = rate(J + 0.5 * h * a);
      const real_t c = rate(J + 0.5 * h * b);
      const real_t d = rate(J + h * c);
      J += h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
   }
   return J;
}
} // namespace

TEST_CASE("A drained column that vessels feed comes to rest")
{
   const bool finite = GENERATE(false, true);
   const int order = GENERATE(1, 2);
   CAPTURE(finite, order);
   // Finite deformation of small strains.
   const real_t pc = finite ? 1e-5 : 0.1;
   Column column(finite, true, pc, order, 80);
   TimeOptions times;
   times.scheme = TimeScheme::backward_euler;
   times.step = 1e7;
   times.end = 2e7;
   const auto [rise, pressure] = column.Run(times);
   const real_t L = std::sqrt(kappa / kp);
   // The pressure is linear: (height/80/L)^2/12 off.
   constexpr real_t close = 5e-5;
   CHECK(pressure ==
         Approx(pc * (1.0 - 1.0 / std::cosh(height / L))).epsilon(close));
   CHECK(rise ==
         Approx(pc / AggregateModulus() * (height - L * std::tanh(height / L)))
            .epsilon(close));
   const StageBalance &balance = column.problem.Operator().Balance();
   const real_t flow = kappa * pc / L * std::tanh(height / L) * 0.09;
   REQUIRE(balance.supply.has_value());
   CHECK(*balance.supply == Approx(flow).epsilon(close));
   CHECK(balance.outflow == Approx(flow).epsilon(close));
   CHECK(std::abs(balance.growth) < 1e-6 * flow);
   CHECK(std::abs(balance.error) < 1e-9 * flow);
}

TEST_CASE("A sealed column that vessels feed swells")
{
   const real_t pc = 0.1;
   const real_t H = AggregateModulus();
   Column column(false, false, pc, 2, 4);
   TimeOptions times;
   times.scheme = TimeScheme::sdirk33;
   times.step = 0.05 / (kp * H);
   times.end = 20.0 * times.step;
   const auto [rise, pressure] = column.Run(times);
   const real_t strain = pc / H * (1.0 - std::exp(-1.0));
   CHECK(rise == Approx(height * strain).epsilon(1e-5));
   CHECK(pressure == Approx(H * strain).epsilon(1e-5));
}

TEST_CASE("In finite deformation it swells as the growing volume is fed")
{
   const int order = GENERATE(1, 2);
   const real_t pc = GENERATE(0.6, -0.25);
   CAPTURE(order, pc);
   Column column(true, false, pc, order, 4);
   TimeOptions times;
   times.scheme = TimeScheme::sdirk33;
   times.end = 1.0 / (kp * AggregateModulus());
   times.step = times.end / 20.0;
   const auto [rise, pressure] = column.Run(times);
   const real_t J = StretchAfter(times.end, pc);
   // By more than a third, and a quarter.
   REQUIRE((J > 1.35 || J < 0.8));
   CHECK(rise == Approx(height * std::abs(J - 1.0)).epsilon(1e-4));
   CHECK(pressure ==
         Approx(std::abs(Stress(NeoHookean(E, nu), J))).epsilon(1e-4));
   // Three stages; an inexact tangent takes more.
   CHECK(column.most_newton <= 12);
}
