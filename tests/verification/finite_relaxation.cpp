// ranks: 2
// timeout: 300
//
// Relaxation in finite deformation, without units, against tables of another
// program: confined (H_A k_0 = 1, height 1) and unconfined (radius 1).

#include "support/boxes.hpp"
#include "support/round_meshes.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t tolerance = 2e-3;

SpaceOptions Finite()
{
   SpaceOptions space;
   space.order = 3;
   space.deformation = Deformation::finite;
   return space;
}

real_t AxisPressure(const ParMesh &mesh, const ParGridFunction &p)
{
   real_t pressure = -std::numeric_limits<real_t>::infinity();
   for (int i = 0; i < mesh.GetNV(); i++)
   {
      real_t x[3];
      const_cast<ParMesh &>(mesh).GetNode(i, x);
      if (std::hypot(x[0], x[1]) < 1e-9)
      {
         pressure = std::max(pressure, p[i]);
      }
   }
   return MaxOverRanks(pressure, mesh.GetComm());
}

// Adaptive steps that end at the times of a table.
TimeOptions Stops(const std::vector<std::pair<real_t, real_t>> &table)
{
   TimeOptions options;
   options.end = table.back().first;
   options.step = 0.1 * table.front().first;
   options.adaptive = true;
   options.error_tolerance = 5e-4;
   options.scheme = TimeScheme::sdirk33;
   for (const auto &row : table)
   {
      options.stops.push_back(row.first);
   }
   return options;
}
} // namespace

TEST_CASE("Confined relaxation without units meets its table")
{
   // H_A k_0 = 1, strain 0.3 within 0.5.
   const HolmesMow solid(1.0, 0.0, 0.35);
   const HolmesMowPermeability permeability(1.0, 2.2, 2.0, 0.2);
   const std::vector<std::pair<real_t, real_t>> table = {
      {0.1, 0.3080809}, {0.25, 0.6783025}, {0.5, 1.935026},
      {0.6, 0.6475316}, {0.75, 0.4794864}, {1.0, 0.4105446},
      {1.5, 0.3922252}, {2.0, 0.3912177},  {3.0, 0.3911579}};
   // J falls to 0.35 at the drained end.
   BoxOptions box;
   box.nz = 12;
   box.grading = 2.0;
   box.size_x = box.size_y = 0.1;
   NamedMesh mesh = MakeBox(box);
   BiphasicProblem problem(mesh, Finite());
   problem.SetMaterial("body", solid, permeability);
   for (const char *side : {"x0", "x1"})
   {
      problem.PrescribeDisplacement(side, 0, 0.0);
   }
   for (const char *side : {"y0", "y1"})
   {
      problem.PrescribeDisplacement(side, 1, 0.0);
   }
   problem.PrescribeDisplacement("z0", 2, 0.0);
   problem.PrescribeDisplacement("z1", 2, Ramp(0.5, -0.3));
   problem.PrescribePressure("z1", 0.0);
   TimeStepper stepper(problem, Stops(table));
   size_t compared = 0;
   while (!stepper.Done())
   {
      const StepReport report = stepper.Step();
      INFO(report.reason);
      REQUIRE(report.converged);
      if (std::abs(stepper.Time() - table[compared].first) < 1e-9)
      {
         const real_t stress = -problem.Reaction(problem.Supports().back())[2] /
                               (box.size_x * box.size_y);
         CAPTURE(stepper.Time());
         CHECK(stress == Approx(table[compared].second).epsilon(tolerance));
         compared++;
      }
   }
   CHECK(compared == table.size());
}

TEST_CASE("Unconfined relaxation without units meets its table")
{
   const NeoHookean solid(1.0, 0.1);
   const ConstantPermeability permeability(1.0);
   // Time and stress, and below the pressure on the axis.
   const std::vector<std::pair<real_t, real_t>> table = {{0.05, 0.2273186},
                                                         {0.1, 0.5416553},
                                                         {0.2, 0.4802601},
                                                         {0.5, 0.4035524},
                                                         {2.0, 0.3778253}};
   const real_t pressures[] = {0.0933388, 0.2378297, 0.2160898, 0.0622186,
                               0.0000383};
   constexpr real_t height = 0.25;
   RoundOptions disc;
   disc.core = 2;
   disc.shells = 3;
   disc.grading = 1.5;
   disc.order = 3;
   disc.height = height;
   NamedMesh mesh = MakeQuarterCylinder(disc);
   BiphasicProblem problem(mesh, Finite());
   problem.SetMaterial("body", solid, permeability);
   problem.PrescribeDisplacement("x0", 0, 0.0);
   problem.PrescribeDisplacement("y0", 1, 0.0);
   problem.PrescribeDisplacement("z0", 2, 0.0);
   problem.PrescribePressure("side", 0.0);
   problem.PrescribeDisplacement("z1", 2, Ramp(0.1, -0.3 * height));
   TimeStepper stepper(problem, Stops(table));
   size_t compared = 0;
   while (!stepper.Done())
   {
      const StepReport report = stepper.Step();
      INFO(report.reason);
      REQUIRE(report.converged);
      if (std::abs(stepper.Time() - table[compared].first) < 1e-9)
      {
         const real_t stress =
            -problem.Reaction(problem.Supports().back())[2] / (0.25 * M_PI);
         const real_t axis = AxisPressure(mesh.Get(), stepper.Pressure());
         CAPTURE(stepper.Time());
         CHECK(stress == Approx(table[compared].second).epsilon(tolerance));
         CHECK(axis == Approx(pressures[compared])
                          .epsilon(0.0)
                          .margin(tolerance * pressures[1]));
         compared++;
      }
   }
   CHECK(compared == table.size());
}
