// ranks: 1 2
//
// A column in confined compression that has been turned by 30 degrees: walls
// that it slides along as guides give the same as prescribed displacements do
// along the axes.

#include "support/boxes.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t angle = M_PI / 6.0;

NamedMesh MakeTurned(bool turned)
{
   BoxOptions box;
   box.nx = box.ny = 2;
   box.nz = 5;
   box.size_x = box.size_y = 0.3;
   Mesh mesh = MakeBoxMesh(box);
   for (int i = 0; turned && i < mesh.GetNV(); i++)
   {
      real_t *const x = mesh.GetVertex(i);
      const real_t a = std::cos(angle) * x[0] - std::sin(angle) * x[1];
      x[1] = std::sin(angle) * x[0] + std::cos(angle) * x[1];
      x[0] = a;
   }
   return DistributeMesh(mesh, {{"body", {1}}},
                         {{"z0", {1}},
                          {"y0", {2}},
                          {"x1", {3}},
                          {"y1", {4}},
                          {"x0", {5}},
                          {"z1", {6}}},
                         MPI_COMM_WORLD);
}

/// Displacement and pressure, the largest ones.
std::pair<real_t, real_t> Press(bool finite, bool turned)
{
   NamedMesh mesh = MakeTurned(turned);
   SpaceOptions space;
   space.deformation =
      finite ? Deformation::finite : Deformation::infinitesimal;
   BiphasicProblem problem(mesh, space);
   const IsotropicElastic linear(0.5, 0.1);
   const NeoHookean deforming(0.5, 0.1);
   const ConstantPermeability permeability(4e-3);
   const SolidLaw *const solid =
      finite ? static_cast<const SolidLaw *>(&deforming) : &linear;
   problem.SetMaterial("body", *solid, permeability);
   problem.PrescribeDisplacement("z0", 2, 0.0);
   problem.PrescribePressure("z1", 0.0);
   problem.AddNormalTraction("z1", -0.2);
   const Point3 across[2] = {{{std::cos(angle), std::sin(angle), 0.0}},
                             {{-std::sin(angle), std::cos(angle), 0.0}}};
   const std::vector<std::string> walls[2] = {{"x0", "x1"}, {"y0", "y1"}};
   for (int d = 0; d < 2; d++)
   {
      if (turned)
      {
         problem.AddGuide(walls[d], across[d]);
         continue;
      }
      for (const std::string &wall : walls[d])
      {
         problem.PrescribeDisplacement(wall, d, 0.0);
      }
   }
   TimeOptions times;
   times.scheme = TimeScheme::backward_euler;
   times.step = 20.0;
   times.end = 100.0;
   TimeStepper stepper(problem, times);
   while (!stepper.Done())
   {
      const StepReport report = stepper.Step();
      INFO(report.reason);
      REQUIRE(report.converged);
   }
   const auto largest = [](const Vector &x)
   { return MaxOverRanks(x.Size() > 0 ? x.Normlinf() : 0.0, MPI_COMM_WORLD); };
   return {largest(stepper.State().GetBlock(0)),
           largest(stepper.State().GetBlock(1))};
}
} // namespace

TEST_CASE("A turned column slides along its guides")
{
   const bool finite = GENERATE(false, true);
   CAPTURE(finite);
   const auto [down, pressure] = Press(finite, false);
   const auto [guided, guided_pressure] = Press(finite, true);
   REQUIRE(down > 0.1);
   REQUIRE(pressure > 0.01);
   CHECK(guided == Approx(down).epsilon(1e-5));
   CHECK(guided_pressure == Approx(pressure).epsilon(1e-5));
}
