// ranks: 1 2 3
//
// Tractions along the normal and fluxes that follow finite deformation.
//
// 1. A block in a homogeneous state sigma_E = t I, turned by any rotation, is
//    in balance with the traction t on all its sides, and a flux Q lets
//    Q x deformed area out.
// 2. A block pressed on its top, free to the sides: Cauchy's stress there is
//    the traction, and the force the traction times the deformed area.
// 3. A tube (radii A, B) with sealed and undrained walls is incompressible:
//    r^2 = R^2 + a^2 - A^2, and for neo-Hookean solids the pressure inside is
//
//      P = mu int (l^2 - l^-2) dr/r = mu [ln l - 1/(2 l^2)] from l_b to l_a
//
//    with l = r/R, as dr/r = -dl/(l (l^2 - 1)).
// 4. The fluid that a flux presses into a body is what its volume grows by.

#include "support/boxes.hpp"
#include "support/round_meshes.hpp"
#include "synovia/fem/total_lagrangian_form.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/materials/permeabilities/constant_permeability.hpp"
#include "synovia/materials/solids/neo_hookean.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <limits>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t young = 0.5;
constexpr real_t poisson = 0.1;
constexpr real_t mu = young / (2.0 * (1.0 + poisson));
constexpr real_t lambda = 2.0 * mu * poisson / (1.0 - 2.0 * poisson);

struct Laws
{
   const NeoHookean solid{young, poisson};
   const ConstantPermeability permeability{4.0e-3};
};

// Cauchy's stress of the law along a principal stretch.
real_t Stress(real_t stretch, real_t J)
{
   return (mu * (stretch * stretch - 1.0) + lambda * std::log(J)) / J;
}

SpaceOptions Finite(int order)
{
   SpaceOptions space;
   space.order = order;
   space.deformation = Deformation::finite;
   return space;
}

// The largest displacement along an axis among the vertices @a here.
real_t LargestAt(const ParMesh &mesh, const ParGridFunction &u, int axis,
                 const std::function<bool(const real_t *)> &here)
{
   real_t largest = -std::numeric_limits<real_t>::infinity();
   for (int i = 0; i < mesh.GetNV(); i++)
   {
      real_t x[3];
      const_cast<ParMesh &>(mesh).GetNode(i, x);
      if (here(x))
      {
         largest = std::max(largest, u[3 * i + axis]);
      }
   }
   return MaxOverRanks(largest, mesh.GetComm());
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
} // namespace

TEST_CASE("Traction and flux turn with the block that they act on")
{
   const auto type =
      GENERATE(Element::HEXAHEDRON, Element::TETRAHEDRON, Element::WEDGE);
   const int order = GENERATE(1, 2);
   CAPTURE(static_cast<int>(type), order);
   constexpr real_t stretch = 0.8;
   constexpr real_t flux = 0.3;
   BoxOptions box;
   box.nx = box.ny = box.nz = 2;
   box.type = type;
   NamedMesh mesh = MakeBox(box);
   BiphasicSpaces spaces(mesh.Get(), order);
   const Laws laws;
   MaterialTable materials;
   materials.Set(mesh.Region("body"), {&laws.solid, &laws.permeability, 0.2});
   BoundaryConditions conditions(spaces, Deformation::finite);
   const real_t traction = Stress(stretch, std::pow(stretch, 3));
   for (const char *side : {"x0", "x1", "y0", "y1", "z0", "z1"})
   {
      conditions.AddNormalTraction(mesh.Boundary(side), traction);
      conditions.AddNormalFlux(mesh.Boundary(side), flux);
   }
   TotalLagrangianForm form(mesh, spaces, materials, conditions.Springs(),
                            conditions.Followers());

   // By 70 degrees about (1, 2, 2)/3.
   const real_t angle = 70.0 / 180.0 * M_PI;
   const Vector axis({1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0});
   VectorFunctionCoefficient turned(
      3,
      [&](const Vector &x, Vector &u)
      {
         Vector across(3);
         axis.cross3D(x, across);
         u.Set(stretch * std::cos(angle) - 1.0, x);
         u.Add(stretch * std::sin(angle), across);
         u.Add(stretch * (1.0 - std::cos(angle)) * (axis * x), axis);
      });
   ParGridFunction field(&spaces.Displacement());
   field.ProjectCoefficient(turned);
   BodyStage stage;
   field.GetTrueDofs(stage.u);
   stage.p.SetSize(spaces.Pressure().GetTrueVSize());
   stage.p = 0.0;
   stage.u0 = stage.u;
   stage.p0 = stage.p;
   stage.dt = 0.5;
   form.GetConserved(stage.u, stage.conserved0);
   form.StartStage(stage, stage.p, stage.dt);
   Vector momentum;
   Vector mass;
   form.Mult(stage, momentum, mass);
   CHECK(MaxOverRanks(momentum.Normlinf(), MPI_COMM_WORLD) < 1e-14);
   const real_t outflow = flux * 6.0 * stretch * stretch;
   CHECK(SumOverRanks(form.Inflow(stage), MPI_COMM_WORLD) ==
         Approx(-outflow).epsilon(1e-12));
   CHECK(SumOverRanks(mass.Sum(), MPI_COMM_WORLD) ==
         Approx(stage.dt * outflow).epsilon(1e-12));
}

TEST_CASE("A block bears the pressure on its deformed area")
{
   constexpr real_t pressure = 0.2;
   BoxOptions box;
   box.nx = box.ny = box.nz = 2;
   box.type = GENERATE(Element::HEXAHEDRON, Element::TETRAHEDRON);
   NamedMesh mesh = MakeBox(box);
   const Laws laws;
   BiphasicProblem problem(mesh, Finite(GENERATE(1, 2)));
   problem.SetMaterial("body", laws.solid, laws.permeability);
   problem.PrescribeDisplacement("x0", 0, 0.0);
   problem.PrescribeDisplacement("y0", 1, 0.0);
   problem.PrescribeDisplacement("z0", 2, 0.0);
   problem.PrescribePressure("x1", 0.0);
   problem.AddNormalTraction("z1", Ramp(1.0, -pressure));
   // Long against the gel time of 500, so that the fluid has left.
   TimeOptions times;
   times.end = 1e6;
   times.step = 1e5;
   TimeStepper stepper(problem, times);
   March(stepper);

   const auto top = [](const real_t *x) { return x[2] > 1.0 - 1e-9; };
   const auto side = [](const real_t *x) { return x[0] > 1.0 - 1e-9; };
   const ParGridFunction &u = stepper.Displacement();
   const real_t along = 1.0 + LargestAt(mesh.Get(), u, 2, top);
   const real_t across = 1.0 + LargestAt(mesh.Get(), u, 0, side);
   const real_t J = along * across * across;
   CAPTURE(along, across);
   CHECK(along < 0.75);
   CHECK(Stress(along, J) == Approx(-pressure).epsilon(1e-6));
   CHECK(Stress(across, J) == Approx(0.0).margin(1e-6 * pressure));
   const real_t force = problem.Reaction(problem.Supports().back())[2];
   CHECK(force == Approx(pressure * across * across).epsilon(1e-6));
}

TEST_CASE("A tube widens by 40 % under the pressure of the closed form")
{
   constexpr real_t inner = 1.0;
   constexpr real_t outer = 2.0;
   constexpr real_t widened = 1.4;
   const real_t outer_stretch =
      std::sqrt(outer * outer + inner * inner * (widened * widened - 1.0)) /
      outer;
   const auto integral = [](real_t l) { return std::log(l) - 0.5 / (l * l); };
   const real_t pressure = mu * (integral(widened) - integral(outer_stretch));

   RingOptions wall;
   wall.inner = inner;
   wall.outer = outer;
   wall.height = 0.2;
   NamedMesh mesh = MakeQuarterRing(wall);
   const Laws laws;
   BiphasicProblem problem(mesh, Finite(2));
   problem.SetMaterial("body", laws.solid, laws.permeability);
   problem.PrescribeDisplacement("x0", 0, 0.0);
   problem.PrescribeDisplacement("y0", 1, 0.0);
   problem.PrescribeDisplacement("z0", 2, 0.0);
   problem.PrescribeDisplacement("z1", 2, 0.0);
   // Short against the gel time of 500: no fluid moves.
   constexpr real_t end = 1e-4;
   problem.AddNormalTraction("inside", Ramp(end, -pressure));
   TimeOptions times;
   times.end = end;
   times.step = 0.1 * end;
   TimeStepper stepper(problem, times);
   March(stepper);
   const real_t found = LargestAt(
      mesh.Get(), stepper.Displacement(), 0,
      [](const real_t *x) { return std::hypot(x[0], x[1]) < inner + 1e-9; });
   CHECK(inner + found == Approx(widened).epsilon(2e-3));
}

TEST_CASE("Fluid that a flux presses into a deforming body makes it grow")
{
   BoxOptions box;
   box.nx = box.ny = box.nz = 2;
   NamedMesh mesh = MakeBox(box);
   const Laws laws;
   BiphasicProblem problem(mesh, Finite(GENERATE(1, 2)));
   problem.SetMaterial("body", laws.solid, laws.permeability);
   problem.PrescribeDisplacement("x0", 0, 0.0);
   problem.PrescribeDisplacement("y0", 1, 0.0);
   problem.PrescribeDisplacement("z0", 2, 0.0);
   constexpr real_t flux = -1.0e-3;
   problem.AddNormalFlux("x1", flux);
   TimeOptions times;
   times.end = 200.0;
   times.step = 50.0;
   TimeStepper stepper(problem, times);
   real_t grown = 0.0;
   real_t outflow = 0.0;
   while (!stepper.Done())
   {
      const StepReport report = stepper.Step();
      INFO(report.reason);
      REQUIRE(report.converged);
      const StageBalance &fluid = problem.Operator().Balance();
      grown += report.dt * fluid.growth;
      CHECK(std::abs(fluid.error) < 1e-7 * fluid.growth);
      outflow += report.dt * fluid.outflow;
   }
   CHECK(-outflow == Approx(grown).epsilon(1e-7));
   // More than through the undeformed area.
   CHECK(grown > 1.02 * -flux * times.end);
   CHECK(grown < 1.3 * -flux * times.end);
}
