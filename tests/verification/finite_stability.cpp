// ranks: 1 2
//
// Stabilized elements of order 1 in finite deformation.
//
// 1. A confined column that bears a load at rest, compressed by a third, gets a
//    tenth more in a step too short for the fluid to move: its pressure takes
//    the increment, without oscillation (stabilization.cpp has the step, and
//    what unstabilized elements do).
// 2. A block glued between plates is compressed by 20 % in a step without flow,
//    and its force is that of elements of order 2 on the same mesh: undrained
//    steps don't lock.
// 3. At rest nothing but the solid resists: with nu = 0.49 elements of order 1,
//    which have no pressure of the solid's, are too stiff, as in infinitesimal
//    strain, and get better with the square of their size.
// 4. With a mean dilatation they are not, in undrained steps and at rest: they
//    agree with order 2 on a finer mesh.

#include "support/boxes.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/materials/permeabilities/constant_permeability.hpp"
#include "synovia/materials/solids/neo_hookean.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t permeability_value = 4.0e-3;

SpaceOptions Space(int order, Deformation deformation = Deformation::finite)
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

struct Squeeze
{
   Element::Type type;
   int order;
   int cells;
   real_t poisson;
   /// Against the gel time of 1000: short is undrained, long is drained.
   real_t duration;
   Deformation deformation = Deformation::finite;
   bool mean_dilatation = false;
};

/// Force of the plate on a block that is glued to it.
real_t SqueezeForce(const Squeeze &squeeze)
{
   BoxOptions box;
   box.nx = box.ny = box.nz = squeeze.cells;
   box.type = squeeze.type;
   NamedMesh mesh = MakeBox(box);
   const NeoHookean solid(0.5, squeeze.poisson);
   const ConstantPermeability permeability(permeability_value);
   BiphasicProblem problem(mesh, Space(squeeze.order, squeeze.deformation));
   problem.SetMaterial("body",
                       {&solid, &permeability, 0.2, squeeze.mean_dilatation});
   // A quarter of the block.
   problem.PrescribeDisplacement("x0", 0, 0.0);
   problem.PrescribeDisplacement("y0", 1, 0.0);
   problem.FixDisplacement("z0");
   problem.PrescribeDisplacement("z1", 0, 0.0);
   problem.PrescribeDisplacement("z1", 1, 0.0);
   problem.PrescribeDisplacement("z1", 2, Ramp(squeeze.duration, -0.2));
   for (const char *side : {"x1", "y1"})
   {
      problem.PrescribePressure(side, 0.0);
   }
   TimeOptions times;
   times.end = squeeze.duration;
   times.step = 0.25 * squeeze.duration;
   TimeStepper stepper(problem, times);
   March(stepper);
   return problem.Reaction(problem.Supports().back())[2];
}
} // namespace

TEST_CASE(
   "The pressure of linear elements does not oscillate in a short step of "
   "a compressed column")
{
   constexpr int cells = 10;
   constexpr real_t load = 0.3;
   constexpr real_t more = 0.03;
   BoxOptions box;
   box.nx = box.ny = 2;
   box.nz = cells;
   box.size_x = box.size_y = 0.2;
   box.type =
      GENERATE(Element::HEXAHEDRON, Element::TETRAHEDRON, Element::WEDGE);
   CAPTURE(static_cast<int>(box.type));
   NamedMesh mesh = MakeBox(box);
   const NeoHookean solid(0.5, 0.1);
   const ConstantPermeability permeability(permeability_value);
   BiphasicProblem problem(mesh, Space(1));
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
   problem.PrescribePressure("z1", 0.0);
   // At rest after many gel times of 500; then a hundredth of the step below
   // which elements that are not stabilized oscillate.
   constexpr real_t rest = 1.0e5;
   const real_t step = std::pow(1.0 / cells, 2) /
                       (6.0 * solid.AggregateModulus() * permeability_value) /
                       100.0;
   problem.AddNormalTraction("z1",
                             LoadCurve({0.0, 1000.0, rest, rest + step},
                                       {0.0, -load, -load, -load - more}));
   TimeOptions times;
   times.end = rest + step;
   times.step = 2000.0;
   times.adaptive = true;
   times.error_tolerance = 2e-2;
   times.min_step = 1e-3;
   times.max_step = 5.0e4;
   TimeStepper stepper(problem, times);
   March(stepper);
   CHECK(MaxOverRanks(-stepper.Displacement().Min(), MPI_COMM_WORLD) > 0.3);

   real_t largest = 0.0;
   real_t rise = 0.0;
   const ParMesh &bodies = mesh.Get();
   constexpr int levels = cells + 1;
   std::vector<real_t> found(levels * 9,
                             -std::numeric_limits<real_t>::infinity());
   for (int i = 0; i < bodies.GetNV(); i++)
   {
      const real_t *x = const_cast<ParMesh &>(bodies).GetVertex(i);
      const int line = static_cast<int>(std::lround(x[0] / 0.1)) +
                       3 * static_cast<int>(std::lround(x[1] / 0.1));
      const int level = static_cast<int>(std::lround(x[2] * cells));
      found[9 * level + line] = stepper.Pressure()[i] / more;
   }
   MPI_Allreduce(MPI_IN_PLACE, found.data(), levels * 9,
                 MPITypeMap<real_t>::mpi_type, MPI_MAX, MPI_COMM_WORLD);
   for (int i = 0; i < levels * 9; i++)
   {
      REQUIRE(std::isfinite(found[i]));
      largest = std::max(largest, found[i]);
      if (i >= 9)
      {
         rise = std::max(rise, found[i] - found[i - 9]);
      }
   }
   CHECK(largest == Approx(1.0).margin(0.01));
   CHECK(rise < 0.01);
}

TEST_CASE("Linear elements don't lock in undrained steps")
{
   const Element::Type type = GENERATE(Element::HEXAHEDRON, Element::WEDGE);
   CAPTURE(static_cast<int>(type));
   constexpr real_t short_time = 1e-3;
   const real_t fine =
      SqueezeForce({Element::HEXAHEDRON, 2, 4, 0.1, short_time});
   const real_t linear = SqueezeForce({type, 1, 6, 0.1, short_time});
   CAPTURE(fine, linear);
   CHECK(linear == Approx(fine).epsilon(0.05));
}

TEST_CASE(
   "Linear elements with a drained solid of nu = 0.49 converge, from too "
   "stiff")
{
   constexpr real_t long_time = 1e7;
   const real_t fine =
      SqueezeForce({Element::HEXAHEDRON, 2, 4, 0.49, long_time});
   const real_t coarse =
      SqueezeForce({Element::HEXAHEDRON, 1, 4, 0.49, long_time});
   const real_t linear =
      SqueezeForce({Element::HEXAHEDRON, 1, 8, 0.49, long_time});
   CAPTURE(fine, coarse, linear);
   CHECK(linear / fine > 1.0);
   CHECK(linear / fine < 1.25);
   CHECK(coarse / fine - 1.0 > 2.5 * (linear / fine - 1.0));
}

TEST_CASE("With a mean dilatation they don't lock")
{
   const auto deformation =
      GENERATE(Deformation::finite, Deformation::infinitesimal);
   const real_t duration = GENERATE(1e-3, 1e7);
   CAPTURE(static_cast<int>(deformation), duration);
   Squeeze squeeze{Element::HEXAHEDRON, 2, 8, 0.49, duration, deformation};
   const real_t fine = SqueezeForce(squeeze);
   squeeze.order = 1;
   squeeze.mean_dilatation = true;
   for (const auto &[type, cells] :
        {std::pair(Element::HEXAHEDRON, 4), std::pair(Element::WEDGE, 6)})
   {
      squeeze.type = type;
      squeeze.cells = cells;
      const real_t linear = SqueezeForce(squeeze);
      CAPTURE(static_cast<int>(type), fine, linear);
      CHECK(linear == Approx(fine).epsilon(0.05));
   }
}
