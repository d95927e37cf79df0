// ranks: 1 2 3
//
// Limits in which finite deformation is known: small loads, where it is
// infinitesimal strain, and rotations, which strain nothing.

#include "support/boxes.hpp"
#include "synovia/fem/stress_recovery.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/materials/permeabilities/constant_permeability.hpp"
#include "synovia/materials/permeabilities/holmes_mow_permeability.hpp"
#include "synovia/materials/solids/holmes_mow.hpp"
#include "synovia/materials/solids/neo_hookean.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t young = 0.5;
constexpr real_t poisson = 0.1;
constexpr real_t permeability_value = 4.0e-3;

SpaceOptions Space(int order, Deformation deformation)
{
   SpaceOptions space;
   space.order = order;
   space.deformation = deformation;
   return space;
}

void March(TimeStepper &stepper)
{
   while (!stepper.Done())
   {
      const StepReport report = stepper.Step();
      INFO(report.reason);
      REQUIRE(report.converged);
   }
}

struct Run
{
   Vector u;
   Vector p;
   Point3 reaction;
   real_t outflow;
};

// A block on springs that a traction by components, a pressure and a flux load,
// and whose one side is held and drained.
Run Solve(Element::Type type, int order, real_t scale, const SolidLaw &solid,
          const PermeabilityLaw &permeability, Deformation deformation)
{
   BoxOptions box;
   box.nx = box.ny = box.nz = 2;
   box.type = type;
   NamedMesh mesh = MakeBox(box);
   BiphasicProblem problem(mesh, Space(order, deformation));
   problem.SetMaterial("body", solid, permeability);
   problem.AddSprings({"z0"}, 0.2);
   problem.AddTraction("y1", Vector({0.2, 0.0, 1.0}), Ramp(20.0, 0.01 * scale));
   problem.AddNormalTraction("z1", Ramp(20.0, -0.05 * scale));
   problem.AddNormalFlux("y0", Ramp(20.0, -1.0e-4 * scale));
   problem.PrescribeDisplacement("x0", 0, Ramp(20.0, 0.05 * scale));
   problem.PrescribePressure("x1", 0.0);
   TimeOptions times;
   times.end = 40.0;
   times.step = 10.0;
   TimeStepper stepper(problem, times);
   March(stepper);
   return {stepper.State().GetBlock(0), stepper.State().GetBlock(1),
           problem.Reaction(problem.Supports().front()),
           problem.Operator().Balance().outflow};
}

// The largest difference, as a part of the largest value.
real_t Difference(const Vector &a, const Vector &b)
{
   Vector difference(a);
   difference -= b;
   real_t largest[2] = {difference.Normlinf(), b.Normlinf()};
   MPI_Allreduce(MPI_IN_PLACE, largest, 2, MPITypeMap<real_t>::mpi_type,
                 MPI_MAX, MPI_COMM_WORLD);
   REQUIRE(largest[1] > 0.0);
   return largest[0] / largest[1];
}
} // namespace

TEST_CASE("With loads times 1e-4 finite deformation is infinitesimal strain")
{
   constexpr real_t small = 1e-4;
   const auto type = GENERATE(Element::HEXAHEDRON, Element::TETRAHEDRON);
   const int order = GENERATE(1, 2);
   CAPTURE(static_cast<int>(type), order);
   const IsotropicElastic linear(young, poisson);
   const ConstantPermeability constant(permeability_value);
   const NeoHookean neo_hookean(young, poisson);
   const ConstantPermeability spatial(permeability_value);
   const HolmesMow holmes_mow(young, poisson, 0.5);
   const HolmesMowPermeability closing(permeability_value, 2.0, 2.0, 0.2);
   const Run infinitesimal =
      Solve(type, order, small, linear, constant, Deformation::infinitesimal);
   // By 10 % where the loads are not scaled.
   CHECK(MaxOverRanks(infinitesimal.u.Normlinf(), MPI_COMM_WORLD) >
         0.1 * small);
   for (const bool stiffening : {false, true})
   {
      CAPTURE(stiffening);
      const Run finite = stiffening ? Solve(type, order, small, holmes_mow,
                                            closing, Deformation::finite)
                                    : Solve(type, order, small, neo_hookean,
                                            spatial, Deformation::finite);
      CHECK(Difference(finite.u, infinitesimal.u) < 1e-4);
      CHECK(Difference(finite.p, infinitesimal.p) < 1e-4);
      CHECK(finite.reaction[0] ==
            Approx(infinitesimal.reaction[0]).epsilon(1e-4));
      CHECK(finite.outflow == Approx(infinitesimal.outflow).epsilon(1e-4));
   }
}

TEST_CASE("A block that is turned by its surface, stretched or not, keeps its "
          "stress")
{
   const int order = GENERATE(1, 2);
   const real_t stretch = GENERATE(1.0, 0.8);
   CAPTURE(order, stretch);
   constexpr real_t turned_by = 0.5 * M_PI;
   BoxOptions box;
   box.nx = box.ny = box.nz = 3;
   NamedMesh mesh = MakeBox(box);
   BiphasicProblem problem(mesh, Space(order, Deformation::finite));
   const NeoHookean solid(young, poisson);
   // No pressure builds up.
   const ConstantPermeability permeability(1e8);
   problem.SetMaterial("body", solid, permeability);
   NonlinearOptions nonlinear;
   nonlinear.linear.relative_tolerance = 1e-10;
   problem.SetNonlinearOptions(nonlinear);
   // Stretched along z until t = 1, then turned about x.
   VectorFunctionCoefficient surface(
      3,
      [&](const Vector &x, real_t t, Vector &u)
      {
         const real_t z = x[2] * (1.0 + (stretch - 1.0) * std::min(t, 1.0));
         const real_t angle = turned_by * std::max(t - 1.0, 0.0) / 6.0;
         u[0] = 0.0;
         u[1] = std::cos(angle) * x[1] - std::sin(angle) * z - x[1];
         u[2] = std::sin(angle) * x[1] + std::cos(angle) * z - x[2];
      });
   problem.Conditions().PrescribeDisplacement(Array<int>({1, 2, 3, 4, 5, 6}),
                                              surface);
   problem.PrescribePressure("x1", 0.0);
   TimeOptions times;
   times.end = 7.0;
   times.step = 1.0;
   TimeStepper stepper(problem, times);
   StressRecovery stress(problem.Spaces().Displacement(), problem.Materials(),
                         Deformation::finite);
   constexpr real_t mu = young / (2.0 * (1.0 + poisson));
   constexpr real_t lambda = 2.0 * mu * poisson / (1.0 - 2.0 * poisson);
   const real_t across = lambda * std::log(stretch) / stretch;
   const real_t along = across + mu * (stretch * stretch - 1.0) / stretch;
   while (!stepper.Done())
   {
      const StepReport report = stepper.Step();
      INFO(report.reason);
      REQUIRE(report.converged);
      stress.Update(stepper.Displacement(), stepper.Pressure());
      // Along the turned axis, and along x.
      const real_t angle = turned_by * (stepper.Time() - 1.0) / 6.0;
      const real_t c = std::cos(angle);
      const real_t s = std::sin(angle);
      ParGridFunction &effective = stress.Effective();
      real_t worst = 0.0;
      for (int i = 0; i < effective.ParFESpace()->GetNDofs(); i++)
      {
         const auto at = [&](int v)
         { return effective[effective.ParFESpace()->DofToVDof(i, v)]; };
         const real_t turned =
            s * s * at(1) + c * c * at(2) - 2.0 * s * c * at(4);
         worst = std::max(
            {worst, std::abs(turned - along), std::abs(at(0) - across)});
      }
      CAPTURE(stepper.Time());
      CHECK(MaxOverRanks(worst, MPI_COMM_WORLD) < 1e-7 * young);
   }
}
