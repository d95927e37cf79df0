// ranks: 1 2 3
// timeout: 300
//
// Cryer's sphere (1963): a sphere with a drained surface is loaded all around
// by a total pressure at once. The surface gives first and squeezes the inside,
// so that the pressure at the center goes on rising, by tens of percent, before
// the fluid leaves (Mandel-Cryer effect): the volume strain is not a multiple
// of the local pressure, and a decoupled (Terzaghi-Rendulic) theory misses it.
// An eighth of the sphere is meshed, with rollers on the planes of symmetry;
// these are impermeable.

#include "support/march.hpp"
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
constexpr real_t radius = 1.0;
constexpr real_t load = 0.01;

/// The largest error of the pressure at the vertices on an axis where the
/// reference has a value, relative to the load; the center's own in @a center.
real_t PressureError(const ReferenceTable &reference, real_t t, March &march,
                     ParMesh &mesh, real_t &center)
{
   // The first dofs are the values at the vertices.
   const ParGridFunction &p = march.Pressure();
   real_t error = 0.0;
   center = 0.0;
   int compared = 0;
   for (int i = 0; i < mesh.GetNV(); i++)
   {
      real_t x[3];
      mesh.GetNode(i, x);
      if (std::hypot(x[1], x[2]) > 1e-12)
      {
         continue;
      }
      for (int row = 0; row < reference.Rows(); row++)
      {
         if (reference.Get(row, "t") == t &&
             std::abs(reference.Get(row, "r") - x[0]) < 1e-9)
         {
            const real_t difference = std::abs(p[i] - reference.Get(row, "p"));
            error = std::max(error, difference / load);
            compared++;
            if (x[0] < 1e-12)
            {
               center = difference / reference.Get(row, "p");
            }
         }
      }
   }
   MPI_Comm comm = mesh.GetComm();
   CHECK(SumOverRanks(compared, comm) >= 3);
   center = MaxOverRanks(center, comm);
   return MaxOverRanks(error, comm);
}
} // namespace

TEST_CASE("The pressure in Cryer's sphere is within 1 %")
{
   RoundOptions ball;
   ball.radius = radius;
   ball.core = 2;
   ball.shells = 3;
   ball.core_size = 0.4;
   ball.order = 3;
   NamedMesh mesh = MakeBallOctant(ball);
   const IsotropicElastic solid(0.5417, 0.0833);
   const ConstantPermeability permeability(4.0e-3);
   // Few large elements of high order; straight ones would be 10 % off.
   SpaceOptions space;
   space.order = 3;
   BiphasicProblem problem(mesh, space);
   problem.SetMaterial("body", solid, permeability);
   problem.PrescribeDisplacement("x0", 0, 0.0);
   problem.PrescribeDisplacement("y0", 1, 0.0);
   problem.PrescribeDisplacement("z0", 2, 0.0);
   problem.PrescribePressure("surface", 0.0);
   problem.AddNormalTraction("surface", -load);

   const ReferenceTable reference("cryer.csv");
   March march(problem);
   // The undrained response at once, and then the rest.
   BackwardEulerSolver backward_euler;
   REQUIRE(march.Step(backward_euler, 0.1));
   SDIRK33Solver sdirk33;
   for (const real_t end : {1.0, 5.0, 20.0, 50.0, 100.0, 200.0, 400.0})
   {
      constexpr int steps = 6;
      const real_t dt = (end - march.Time()) / steps;
      for (int i = 0; i < steps; i++)
      {
         REQUIRE(march.Step(sdirk33, dt));
      }
      if (end >= 20.0)
      {
         real_t center = 0.0;
         const real_t error =
            PressureError(reference, end, march, mesh.Get(), center);
         CAPTURE(end);
         CHECK(error < 0.01);
         CHECK(center < 0.01);
      }
   }
}
