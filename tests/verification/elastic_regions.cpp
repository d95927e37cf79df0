// ranks: 1 2
//
// Regions without fluid beside biphasic ones.
//
// 1. A confined column of an elastic part of height a and modulus H_e below a
//    biphasic one of height b, H and kappa, whose top drains and is loaded at
//    once by -P. The total traction is -P everywhere, so that the elastic part
//    is compressed by P a/H_e from the start, and the biphasic one consolidates
//    as on a sealed, rigid base (Terzaghi): with m = (n + 1/2) pi, n >= 0, and
//    s = H kappa t/b^2
//
//       pressure of the interface   P sum 2 (-1)^n/m exp(-m^2 s)
//       compression                 P b/H (1 - sum 2/m^2 exp(-m^2 s))
//
// 2. At rest they are bars in series, and a body without any fluid is one bar.
// 3. Nothing of the fluid can be prescribed where there is none.

#include "support/boxes.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/io/step_diagnostics.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t below = 0.3;
constexpr real_t above = 0.7;
constexpr real_t kappa = 4e-3;
// Small enough for finite deformation to be infinitesimal.
constexpr real_t load = 1e-5;

struct Solids
{
   IsotropicElastic lower{2.0, 0.2};
   IsotropicElastic upper{0.5, 0.1};
   NeoHookean finite_lower{2.0, 0.2};
   NeoHookean finite_upper{0.5, 0.1};
   ConstantPermeability permeability{kappa};
};

real_t AggregateModulus(real_t young, real_t poisson)
{
   return young * (1.0 - poisson) / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
}

NamedMesh Column(Element::Type type)
{
   BoxOptions box;
   box.nx = box.ny = 2;
   box.nz = 20;
   box.type = type;
   box.size_x = box.size_y = 0.2;
   Mesh serial = MakeBoxMesh(box);
   for (int i = 0; i < serial.GetNE(); i++)
   {
      Vector center(3);
      serial.GetElementCenter(i, center);
      serial.SetAttribute(i, center[2] < below ? 1 : 2);
   }
   serial.SetAttributes();
   return DistributeMesh(serial, {{"lower", {1}}, {"upper", {2}}},
                         {{"z0", {1}},
                          {"y0", {2}},
                          {"x1", {3}},
                          {"y1", {4}},
                          {"x0", {5}},
                          {"z1", {6}}},
                         MPI_COMM_WORLD);
}

void Confine(BiphasicProblem &problem)
{
   problem.PrescribeDisplacement("z0", 2, 0.0);
   for (const char *name : {"x0", "x1"})
   {
      problem.PrescribeDisplacement(name, 0, 0.0);
   }
   for (const char *name : {"y0", "y1"})
   {
      problem.PrescribeDisplacement(name, 1, 0.0);
   }
   problem.AddNormalTraction("z1", -load);
}

real_t Largest(const Vector &x)
{
   return MaxOverRanks(x.Size() > 0 ? x.Normlinf() : 0.0, MPI_COMM_WORLD);
}

real_t Series(real_t s, bool pressure)
{
   real_t sum = 0.0;
   for (int n = 0; n < 200; n++)
   {
      const real_t m = (n + 0.5) * M_PI;
      sum += std::exp(-m * m * s) *
             (pressure ? (n % 2 == 0 ? 2.0 : -2.0) / m : 2.0 / (m * m));
   }
   return pressure ? sum : 1.0 - sum;
}

TimeOptions Times(real_t step, int steps)
{
   TimeOptions times;
   times.step = step;
   times.end = steps * step;
   times.scheme = TimeScheme::sdirk33;
   times.cut_back = false;
   return times;
}

NonlinearOptions Solve(LinearMethod method)
{
   NonlinearOptions options;
   options.linear.method = method;
   options.linear.relative_tolerance = 1e-10;
   return options;
}
} // namespace

TEST_CASE("A layer consolidates on an elastic one as on a sealed base")
{
   const bool finite = GENERATE(false, true);
   const int order = GENERATE(1, 2);
   const LinearMethod method =
      GENERATE(LinearMethod::direct, LinearMethod::block_amg);
   const Element::Type type =
      order == 2 ? Element::HEXAHEDRON
                 : GENERATE(Element::HEXAHEDRON, Element::TETRAHEDRON);
   CAPTURE(finite, order, static_cast<int>(method), static_cast<int>(type));
   const Solids solids;
   NamedMesh mesh = Column(type);
   SpaceOptions space;
   space.order = order;
   space.deformation =
      finite ? Deformation::finite : Deformation::infinitesimal;
   BiphasicProblem problem(mesh, space);
   if (finite)
   {
      problem.SetMaterial("lower", solids.finite_lower);
      problem.SetMaterial("upper", solids.finite_upper, solids.permeability);
   }
   else
   {
      problem.SetMaterial("lower", solids.lower);
      problem.SetMaterial("upper", solids.upper, solids.permeability);
   }
   Confine(problem);
   problem.PrescribePressure("z1", 0.0);
   problem.SetNonlinearOptions(Solve(method));
   const real_t lower = AggregateModulus(2.0, 0.2);
   const real_t upper = AggregateModulus(0.5, 0.1);
   const real_t unit = above * above / (upper * kappa);
   TimeStepper stepper(problem, Times(0.02 * unit, 25));
   const real_t tolerance = order == 2 ? 2e-3 : 1e-2;
   while (!stepper.Done())
   {
      const StepReport report = stepper.Step();
      INFO(report.reason);
      REQUIRE(report.converged);
      const real_t s = report.time / unit;
      CAPTURE(s);
      for (const auto &[name, value] :
           StepDiagnostics(problem, stepper, report))
      {
         if (name == "fluid.volume_balance")
         {
            CHECK(std::abs(value) < 1e-6 * load * above / upper / unit);
         }
      }
      // What the jump of the load made has gone by then.
      if (s > (order == 2 ? 0.1 : 0.3))
      {
         CHECK(Largest(stepper.State().GetBlock(1)) ==
               Approx(load * Series(s, true)).epsilon(tolerance));
         CHECK(Largest(stepper.State().GetBlock(0)) ==
               Approx(load * (below / lower + above / upper * Series(s, false)))
                  .epsilon(tolerance));
      }
   }
}

TEST_CASE("At rest elastic and biphasic parts are bars in series")
{
   const bool wet = GENERATE(false, true);
   const bool finite = GENERATE(false, true);
   CAPTURE(wet, finite);
   const Solids solids;
   NamedMesh mesh = Column(Element::HEXAHEDRON);
   SpaceOptions space;
   space.deformation =
      finite ? Deformation::finite : Deformation::infinitesimal;
   BiphasicProblem problem(mesh, space);
   Material lower;
   lower.solid = finite ? static_cast<const SolidLaw *>(&solids.finite_lower)
                        : &solids.lower;
   Material upper;
   upper.solid = finite ? static_cast<const SolidLaw *>(&solids.finite_upper)
                        : &solids.upper;
   upper.permeability = wet ? &solids.permeability : nullptr;
   problem.SetMaterial("lower", lower);
   problem.SetMaterial("upper", upper);
   Confine(problem);
   if (wet)
   {
      problem.PrescribePressure("z1", 0.0);
   }
   TimeStepper stepper(problem, Times(1e9, 1));
   const StepReport report = stepper.Step();
   INFO(report.reason);
   REQUIRE(report.converged);
   CHECK(Largest(stepper.State().GetBlock(0)) ==
         Approx(load * (below / AggregateModulus(2.0, 0.2) +
                        above / AggregateModulus(0.5, 0.1)))
            .epsilon(finite ? 1e-4 : 1e-6));
   CHECK(Largest(stepper.State().GetBlock(1)) < 1e-6 * load);
}

TEST_CASE("What the fluid does can't be prescribed where there is none")
{
   const Solids solids;
   NamedMesh mesh = Column(Element::HEXAHEDRON);
   BiphasicProblem problem(mesh, SpaceOptions());
   problem.SetMaterial("lower", solids.lower);
   problem.SetMaterial("upper", solids.upper, solids.permeability);
   problem.PrescribePressure("z1", 0.0);
   // Sides have both.
   problem.PrescribePressure("x0", 0.0);
   CHECK_NOTHROW(problem.VerifyFluid());
   problem.AddNormalFlux("z0", 1.0);
   CHECK_THROWS_WITH(problem.VerifyFluid(),
                     Catch::Contains("on \"z0\", but the body there has none"));
}
