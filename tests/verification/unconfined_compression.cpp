// ranks: 1 2 3
// timeout: 300
//
// Unconfined compression of a disc between frictionless impermeable platens
// (Armstrong, Lai & Mow 1984): the strain along the axis is uniform, radial
// displacement and pressure depend on r and t only. The axis' strain is ramped
// to 10 % in 500 s, then held. As nothing depends on z, a thin slab does, and
// by symmetry a quarter of it.

#include "support/reference_table.hpp"
#include "support/round_meshes.hpp"
#include "synovia/synovia.hpp"

#include "synovia/general/reduce.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t radius = 1.5;
constexpr real_t height = 0.25;
constexpr real_t strain = 0.1;

/// What a slab has on the axis and at the rim.
struct Values
{
   real_t pressure;
   real_t edge;
};

Values Evaluate(TimeStepper &stepper, ParMesh &mesh)
{
   const ParGridFunction &u = stepper.Displacement();
   const ParGridFunction &p = stepper.Pressure();
   Values values{0.0, 0.0};
   for (int i = 0; i < mesh.GetNV(); i++)
   {
      real_t x[3];
      mesh.GetNode(i, x);
      const real_t r = std::hypot(x[0], x[1]);
      if (r < 1e-12)
      {
         values.pressure = std::max(values.pressure, p[i]);
      }
      else if (r > radius - 1e-9)
      {
         // The first dofs are the vertices', by node.
         values.edge =
            std::max(values.edge, (u[3 * i] * x[0] + u[3 * i + 1] * x[1]) / r);
      }
   }
   values.pressure = MaxOverRanks(values.pressure, mesh.GetComm());
   values.edge = MaxOverRanks(values.edge, mesh.GetComm());
   return values;
}
} // namespace

TEST_CASE("Unconfined compression meets the exact force, rim and pressure "
          "within 0.1 %")
{
   RoundOptions disc;
   disc.radius = radius;
   disc.core = 2;
   disc.shells = 3;
   disc.grading = 1.5;
   disc.order = 3;
   disc.height = height;
   NamedMesh mesh = MakeQuarterCylinder(disc);
   const IsotropicElastic solid(0.5417, 0.0833);
   const ConstantPermeability permeability(4.0e-3);
   SpaceOptions space;
   space.order = 3;
   BiphasicProblem problem(mesh, space);
   problem.SetMaterial("body", solid, permeability);
   problem.PrescribeDisplacement("x0", 0, 0.0);
   problem.PrescribeDisplacement("y0", 1, 0.0);
   problem.PrescribeDisplacement("z0", 2, 0.0);
   problem.PrescribePressure("side", 0.0);
   problem.PrescribeDisplacement("z1", 2, Ramp(500.0, -strain * height));
   TimeOptions options;
   options.end = 1000.0;
   options.step = 25.0;
   options.scheme = TimeScheme::sdirk33;
   TimeStepper stepper(problem, options);

   const ReferenceTable reference("unconfined_ramp_force.csv");
   int compared = 0;
   while (!stepper.Done())
   {
      REQUIRE(stepper.Step().converged);
      const real_t t = stepper.Time();
      for (const real_t when :
           {50.0, 100.0, 250.0, 500.0, 550.0, 700.0, 1000.0})
      {
         if (std::abs(t - when) > 1e-9)
         {
            continue;
         }
         // A quarter of the disc.
         const real_t force =
            -4.0 * problem.Reaction(problem.Supports().back())[2];
         const Values values = Evaluate(stepper, mesh.Get());
         CAPTURE(t);
         CHECK(force == Approx(reference.Find({{"t", t}}, "F")).epsilon(1e-3));
         CHECK(values.edge ==
               Approx(reference.Find({{"t", t}}, "ur_edge")).epsilon(1e-3));
         const real_t pressure = reference.Find({{"t", t}}, "p_axis");
         // Later there is next to nothing left of it.
         if (t <= 550.0)
         {
            CHECK(values.pressure == Approx(pressure).epsilon(1e-3));
         }
         compared++;
      }
   }
   CHECK(compared == 7);
}
