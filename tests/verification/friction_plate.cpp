// ranks: 1 2
// timeout: 300
//
// Confined creep of a column whose sealed end slides on a plate, with Coulomb's
// friction on the share of the load that the solid bears (Zimmerman & Ateshian,
// J Biomech Eng 144(6):061006, 2022). Nothing moves the column's points across,
// so that the pressure p(t) at its end is that of confined creep, and
//
//     mu_eff = mu_eq [1 - (1 - phi) p/P].
//
// p/P is from a one-dimensional solution with another program. The plate's
// points are all prescribed, so that it holds no more fluid than at first:
// rigid and, as a whole, impermeable. It slides by a small part of its size,
// lest it drains where the column doesn't cover it.

#include "support/boxes.hpp"
#include "support/reference_table.hpp"
#include "synovia/contact/contact_diagnostics.hpp"
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
constexpr real_t load = 0.1;
constexpr real_t ramp = 0.05;
constexpr real_t mu = 0.3;
constexpr real_t phi = 0.04;
// Of the sliding (length / time).
constexpr real_t speed = 0.002;

const std::vector<real_t> reference_times{0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 4.0};
} // namespace

TEST_CASE("Fluid that bears the load does not rub")
{
   BoxOptions plate;
   plate.nx = 3;
   plate.ny = 3;
   plate.nz = 1;
   plate.size_x = 0.4;
   plate.size_y = 0.4;
   plate.size_z = 0.1;
   BoxOptions column;
   column.nx = 2;
   column.ny = 2;
   column.nz = 16;
   column.size_x = 0.4;
   column.size_y = 0.4;
   column.grading = 1.5;
   NamedMesh mesh = MakeStack(plate, column);
   const HolmesMow solid(1.0, 0.0, 0.35);
   const HolmesMowPermeability fluid(1.0, 2.2, 2.0, 0.2);
   const NeoHookean stiff(1.0, 0.0);
   const ConstantPermeability tight(1.0e-2);
   SpaceOptions space;
   space.deformation = Deformation::finite;
   BiphasicProblem problem(mesh, space);
   problem.SetMaterial("lower", stiff, tight);
   problem.SetMaterial("upper", solid, fluid);
   const real_t angle = GENERATE(0.0, 0.7);
   for (const std::string side : {"x0", "x1", "y0", "y1", "z0", "z1"})
   {
      const real_t way = 4.0 * speed;
      problem.PrescribeDisplacement("lower_" + side, 0,
                                    Ramp(4.0, way * std::cos(angle)));
      problem.PrescribeDisplacement("lower_" + side, 1,
                                    Ramp(4.0, way * std::sin(angle)));
      problem.PrescribeDisplacement("lower_" + side, 2, 0.0);
   }
   for (const std::string side : {"x0", "x1", "y0", "y1", "z0", "z1"})
   {
      problem.PrescribeDisplacement("upper_" + side, 0, 0.0);
      problem.PrescribeDisplacement("upper_" + side, 1, 0.0);
   }
   problem.PrescribePressure("upper_z1", 0.0);
   problem.AddTraction("upper_z1", Vector({0.0, 0.0, -1.0}), Ramp(ramp, load));
   ContactOptions contact;
   contact.friction = {mu, phi};
   problem.AddContact("lower_z1", "upper_z0", contact);
   TimeOptions times;
   times.end = 4.0;
   times.step = ramp / 10.0;
   times.adaptive = true;
   times.error_tolerance = 5e-4;
   times.scheme = TimeScheme::sdirk33;
   times.stops = reference_times;
   TimeStepper stepper(problem, times);
   const ReferenceTable reference("friction_creep.csv");
   auto next = reference_times.begin();
   int halves = 0;
   real_t dissipation = 0.0;
   while (!stepper.Done())
   {
      const StepReport report = stepper.Step();
      INFO(report.reason);
      REQUIRE(report.converged);
      // Of all three stages. At the start and after the ramp's corner a step is
      // taken as a whole and in halves.
      const real_t begin = report.time - report.dt;
      const bool halved = begin < 1e-9 || std::abs(begin - ramp) < 1e-9;
      CAPTURE(begin, report.solve.newton);
      CHECK(report.failures == 0);
      CHECK(report.solve.newton <= (halved ? 3 * 9 : 9));
      halves += halved ? 1 : 0;
      const ContactDiagnostics now =
         Diagnose(*problem.Operator().Pairs().front());
      CHECK(now.friction.dissipation >= dissipation);
      dissipation = now.friction.dissipation;
      if (std::abs(stepper.Time() - *next) > 1e-9)
      {
         continue;
      }
      CAPTURE(*next, now.fluid_load_support, now.friction.sliding);
      const real_t pressure = reference.Find({{"t", *next}}, "p_over_P");
      const real_t expected = mu * (1.0 - (1.0 - phi) * pressure);
      CHECK(now.friction.coefficient == Approx(expected).epsilon(0.01));
      const real_t force = now.friction.coefficient * load * 0.4 * 0.4;
      // On the column, along the plate's motion; its rim is not quite covered.
      CHECK(std::abs(now.friction.force[0] - force * std::cos(angle)) <=
            2e-3 * force);
      CHECK(std::abs(now.friction.force[1] - force * std::sin(angle)) <=
            2e-3 * force);
      CHECK(now.friction.sliding == 1.0);
      next++;
   }
   CHECK(next == reference_times.end());
   CHECK(halves == 2);
   CHECK(stepper.Steps() >= 30);
}
