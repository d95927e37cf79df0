// ranks: 1 2 3
// timeout: 300
//
// Contact of bodies that deform by 30 %: columns on columns, meshes that don't
// match, loaded blocks that turn by 90 degrees, and blocks that slide.

#include "support/boxes.hpp"
#include "support/reference_table.hpp"
#include "synovia/contact/contact_diagnostics.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/materials/permeabilities/constant_permeability.hpp"
#include "synovia/materials/permeabilities/holmes_mow_permeability.hpp"
#include "synovia/materials/solids/holmes_mow.hpp"
#include "synovia/materials/solids/neo_hookean.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

using namespace mfem;
using namespace synovia;

namespace
{
// Thousands of gel times.
constexpr real_t long_time = 1.0e9;

SpaceOptions Finite(int order)
{
   SpaceOptions space;
   space.order = order;
   space.deformation = Deformation::finite;
   return space;
}

NonlinearOptions Exact()
{
   NonlinearOptions nonlinear;
   nonlinear.linear.method = LinearMethod::direct;
   nonlinear.linear.relative_tolerance = 1e-12;
   return nonlinear;
}

ContactOptions Closed()
{
   ContactOptions contact;
   contact.gap_tolerance = 1e-11;
   contact.pressure_tolerance = 1e-9;
   return contact;
}

void HoldSides(BiphasicProblem &problem)
{
   for (const std::string body : {"lower_", "upper_"})
   {
      problem.PrescribeDisplacement(body + "x0", 0, 0.0);
      problem.PrescribeDisplacement(body + "x1", 0, 0.0);
      problem.PrescribeDisplacement(body + "y0", 1, 0.0);
      problem.PrescribeDisplacement(body + "y1", 1, 0.0);
   }
   problem.PrescribeDisplacement("lower_z0", 2, 0.0);
}

// The largest value at vertices of a field's component.
real_t LargestAt(const ParMesh &mesh, const ParGridFunction &field, int width,
                 int component, const std::function<bool(const real_t *)> &here)
{
   real_t largest = -infinity();
   for (int i = 0; i < mesh.GetNV(); i++)
   {
      real_t x[3];
      const_cast<ParMesh &>(mesh).GetNode(i, x);
      if (here(x))
      {
         largest = std::max(largest, field[width * i + component]);
      }
   }
   return MaxOverRanks(largest, mesh.GetComm());
}

StepReport MustStep(TimeStepper &stepper)
{
   const StepReport report = stepper.Step();
   INFO(report.reason);
   REQUIRE(report.converged);
   return report;
}

// Tractions of a pair's vertices that touch, nominal.
struct Spread
{
   real_t least = infinity();
   real_t most = -infinity();
};

Spread Tractions(const ContactPair &pair, MPI_Comm comm)
{
   Spread spread;
   const ContactState &state = pair.State();
   for (int j = 0; j < state.traction.Size(); j++)
   {
      if (state.vertices[j].touches)
      {
         spread.least = std::min(spread.least, state.traction[j]);
         spread.most = std::max(spread.most, state.traction[j]);
      }
   }
   spread.least = -MaxOverRanks(-spread.least, comm);
   spread.most = MaxOverRanks(spread.most, comm);
   return spread;
}
} // namespace

TEST_CASE("Two columns in contact are one column, compressed by 30 %")
{
   const bool stiffening = GENERATE(false, true);
   CAPTURE(stiffening);
   BoxOptions lower;
   lower.nz = 16;
   lower.size_x = lower.size_y = 0.1;
   lower.size_z = 0.5;
   BoxOptions upper = lower;
   upper.nx = 2;
   NamedMesh mesh = MakeStack(lower, upper);
   const NeoHookean neo_hookean(0.5, 0.1);
   const ConstantPermeability constant(4.0e-3);
   const HolmesMow holmes_mow(0.5, 0.1, 0.5);
   const HolmesMowPermeability closing(4.0e-3, 2.0, 2.0, 0.2);
   BiphasicProblem problem(mesh, Finite(2));
   for (const char *body : {"lower", "upper"})
   {
      if (stiffening)
      {
         problem.SetMaterial(body, holmes_mow, closing);
      }
      else
      {
         problem.SetMaterial(body, neo_hookean, constant);
      }
   }
   HoldSides(problem);
   problem.PrescribeDisplacement("upper_z1", 2, Ramp(500.0, -0.3));
   problem.PrescribePressure("upper_z1", 0.0);
   ContactOptions contact;
   contact.gap_tolerance = 1e-6;
   contact.pressure_tolerance = 1e-4;
   problem.AddContact("upper_z0", "lower_z1", contact);
   TimeOptions times;
   times.end = 500.0;
   times.step = 25.0;
   times.scheme = TimeScheme::sdirk33;
   TimeStepper stepper(problem, times);
   const ReferenceTable reference(
      stiffening ? "finite_confined_holmesmow.csv"
                 : "finite_confined_neohookean_constant.csv");
   const real_t peak = reference.Find({{"t", 500.0}}, "p_base");
   int compared = 0;
   while (!stepper.Done())
   {
      const StepReport report = MustStep(stepper);
      CHECK(report.solve.newton <=
            8 * (1 + report.solve.augmentations) * report.solves);
      const real_t t = stepper.Time();
      if (std::abs(t - 250.0) > 1e-9 && std::abs(t - 500.0) > 1e-9)
      {
         continue;
      }
      CAPTURE(t);
      constexpr real_t tolerance = 2e-3;
      const real_t stress =
         problem.Reaction(problem.Supports().back())[2] / 0.01;
      const real_t middle =
         LargestAt(mesh.Get(), stepper.Displacement(), 3, 2,
                   [](const real_t *x) { return std::abs(x[2] - 0.5) < 1e-9; });
      const real_t base =
         LargestAt(mesh.Get(), stepper.Pressure(), 1, 0,
                   [](const real_t *x) { return std::abs(x[2]) < 1e-9; });
      CHECK(stress ==
            Approx(reference.Find({{"t", t}}, "stress")).epsilon(tolerance));
      CHECK(middle ==
            Approx(reference.Find({{"t", t}}, "u_mid")).epsilon(tolerance));
      CHECK(base == Approx(reference.Find({{"t", t}}, "p_base"))
                       .epsilon(0.0)
                       .margin(tolerance * peak));
      compared++;
   }
   CHECK(compared == 2);
}

// Held at the sides and drained, lower and upper block are in uniform stress:
//
//     P = mu (s - 1/s) + lambda log(s) / s,    h_1 s_1 + h_2 s_2 = h - delta
TEST_CASE("Meshes that don't match pass the patch test at 30 % compression")
{
   const auto type = GENERATE(Element::HEXAHEDRON, Element::TETRAHEDRON);
   const int order = GENERATE(1, 2);
   CAPTURE(static_cast<int>(type), order);
   BoxOptions lower;
   lower.nx = 2;
   lower.ny = 2;
   lower.nz = 2;
   lower.type = type;
   lower.size_z = 0.6;
   BoxOptions upper = lower;
   upper.nx = 3;
   upper.ny = 3;
   upper.size_z = 0.5;
   NamedMesh mesh = MakeStack(lower, upper);
   const std::array<real_t, 2> young{{0.5, 0.9}};
   const std::array<real_t, 2> poisson{{0.3, 0.2}};
   const std::array<real_t, 2> heights{{lower.size_z, upper.size_z}};
   const NeoHookean lower_solid(young[0], poisson[0]);
   const NeoHookean upper_solid(young[1], poisson[1]);
   const ConstantPermeability fluid(4.0e-3);
   BiphasicProblem problem(mesh, Finite(order));
   problem.SetMaterial("lower", lower_solid, fluid);
   problem.SetMaterial("upper", upper_solid, fluid);
   HoldSides(problem);
   const real_t descent = 0.3 * (heights[0] + heights[1]);
   problem.PrescribeDisplacement("upper_z1", 2, Ramp(long_time, -descent));
   problem.PrescribePressure("lower_z0", 0.0);
   problem.PrescribePressure("upper_z1", 0.0);
   problem.AddContact("upper_z0", "lower_z1", Closed());
   problem.SetNonlinearOptions(Exact());
   TimeOptions times;
   times.end = long_time;
   times.step = long_time / 4.0;
   TimeStepper stepper(problem, times);
   while (!stepper.Done())
   {
      MustStep(stepper);
   }

   const auto stress = [&](int body, real_t stretch)
   {
      const LameModuli moduli(young[body], poisson[body]);
      return moduli.mu * (stretch - 1.0 / stretch) +
             moduli.lambda * std::log(stretch) / stretch;
   };
   real_t low = 0.3;
   real_t high = 1.0;
   real_t other = 1.0;
   for (int i = 0; i < 60; i++)
   {
      const real_t s = 0.5 * (low + high);
      other = (heights[0] + heights[1] - descent - heights[0] * s) / heights[1];
      (stress(0, s) < stress(1, other) ? low : high) = s;
   }
   const ContactPair &pair = *problem.Operator().Pairs().front();
   const Spread tractions = Tractions(pair, mesh.GetComm());
   constexpr real_t solved = 1e-7;
   CHECK(tractions.least == Approx(stress(1, other)).epsilon(solved));
   CHECK(tractions.most == Approx(stress(1, other)).epsilon(solved));
   const real_t reaction = problem.Reaction(problem.Supports().back())[2];
   CHECK(reaction == Approx(stress(1, other)).epsilon(solved));
   const ContactDiagnostics forces = Diagnose(pair);
   CHECK(forces.area == Approx(1.0).epsilon(1e-9));
   CHECK(forces.source_force[2] ==
         Approx(-forces.destination_force[2]).epsilon(1e-12));
}

namespace
{
// Turned about the y axis by an angle that grows with time, after the body was
// pressed together along z.
class Turned : public VectorCoefficient
{
public:
   Turned() : VectorCoefficient(3) {}
   void Eval(Vector &u, ElementTransformation &trans,
             const IntegrationPoint &ip) override
   {
      Vector x(3);
      trans.Transform(ip, x);
      const real_t pressed = std::min<real_t>(GetTime() / press_time, 1.0);
      const real_t angle =
         0.5 * M_PI *
         std::max<real_t>(0.0, GetTime() / press_time - turn_start) / turns;
      const real_t z = x[2] * (1.0 - 0.3 * pressed);
      u.SetSize(3);
      u[0] = std::cos(angle) * x[0] + std::sin(angle) * z - x[0];
      u[1] = 0.0;
      u[2] = -std::sin(angle) * x[0] + std::cos(angle) * z - x[2];
   }

   static constexpr real_t press_time = long_time;
   // Times press_time: when all is at rest, and what faces bear, too.
   static constexpr real_t turn_start = 2.6;
   // Times press_time: how long a quarter of a turn takes.
   static constexpr real_t turns = 2.0;
};
} // namespace

TEST_CASE("Loaded blocks in contact may be turned by 90 degrees")
{
   BoxOptions lower;
   lower.nx = 3;
   lower.ny = 2;
   lower.nz = 2;
   lower.size_y = 0.7;
   lower.size_z = 0.5;
   BoxOptions upper = lower;
   upper.nx = 2;
   upper.ny = 1;
   upper.size_x = 0.8;
   NamedMesh mesh = MakeStack(lower, upper);
   const NeoHookean lower_solid(0.5, 0.3);
   const HolmesMow upper_solid(0.7, 0.1, 0.5);
   const HolmesMowPermeability fluid(4.0e-3, 2.0, 2.0, 0.2);
   BiphasicProblem problem(mesh, Finite(2));
   problem.SetMaterial("lower", lower_solid, fluid);
   problem.SetMaterial("upper", upper_solid, fluid);
   Turned turned;
   Array<int> held(mesh.Boundary("lower_z0"));
   held.Append(mesh.Boundary("upper_z1"));
   problem.Conditions().PrescribeDisplacement(held, turned);
   problem.PrescribePressure("lower_z0", 0.0);
   problem.PrescribePressure("upper_z1", 0.02);
   problem.AddContact("lower_z1", "upper_z0", Closed());
   problem.SetNonlinearOptions(Exact());
   TimeOptions times;
   times.end = (Turned::turn_start + Turned::turns) * Turned::press_time;
   times.step = Turned::press_time / 5.0;
   TimeStepper stepper(problem, times);
   const ContactPair &pair = *problem.Operator().Pairs().front();
   Vector tractions;
   Vector pressures;
   const auto compare = [&](const Vector &now, const Vector &before)
   {
      Vector change(now);
      change -= before;
      const real_t size =
         GlobalLpNorm(infinity(), before.Normlinf(), mesh.GetComm());
      CHECK(size > 0.0);
      CHECK(GlobalLpNorm(infinity(), change.Normlinf(), mesh.GetComm()) <=
            1e-8 * size);
   };
   while (!stepper.Done())
   {
      MustStep(stepper);
      const real_t t = stepper.Time() / Turned::press_time;
      if (std::abs(t - Turned::turn_start) < 1e-9)
      {
         tractions = pair.State().traction;
         pressures = stepper.State().GetBlock(1);
      }
   }
   compare(pair.State().traction, tractions);
   compare(stepper.State().GetBlock(1), pressures);
   const ContactDiagnostics forces = Diagnose(pair);
   real_t moment = 0.0;
   for (int d = 0; d < 3; d++)
   {
      moment = std::max(moment, std::abs(forces.source_moment[d] +
                                         forces.destination_moment[d]));
      CHECK(std::abs(forces.source_force[d] + forces.destination_force[d]) <=
            1e-12 * std::abs(forces.source_force[0]));
   }
   // What pressed along z now presses along x.
   CHECK(std::abs(forces.source_force[0]) > 0.05);
   CHECK(moment <= 1e-12);
}

namespace
{
// A block with a round underside, turned against the edges of the faces below
// it, is pressed into a block and moved on: Newton's iterations of that step
// for a relative accuracy.
int Iterations(real_t accuracy)
{
   BoxOptions lower;
   lower.nx = 3;
   lower.ny = 2;
   lower.nz = 1;
   lower.size_y = 0.8;
   lower.size_z = 0.5;
   BoxOptions upper = lower;
   upper.nx = 2;
   upper.ny = 2;
   upper.size_x = 0.7;
   upper.size_y = 0.6;
   Mesh serial = MakeStackMesh(lower, upper);
   serial.SetCurvature(2);
   serial.Transform(
      [=](const Vector &x, Vector &y)
      {
         y = x;
         y[2] += 0.2 * x[0] * x[0] + 0.1 * x[0] * x[1];
      });
   NamedMesh mesh = DistributeStack(serial, MPI_COMM_WORLD);
   const NeoHookean lower_solid(0.5, 0.3);
   const NeoHookean upper_solid(1.0, 0.3);
   const ConstantPermeability fluid(4.0e-3);
   BiphasicProblem problem(mesh, Finite(2));
   problem.SetMaterial("lower", lower_solid, fluid);
   problem.SetMaterial("upper", upper_solid, fluid);
   problem.FixDisplacement("lower_z0");
   problem.PrescribeDisplacement(
      "upper_z1", 0, LoadCurve({0.0, long_time, 2.0 * long_time}, {0, 0, 0.1}));
   problem.PrescribeDisplacement("upper_z1", 1, 0.0);
   problem.PrescribeDisplacement("upper_z1", 2, Ramp(long_time, -0.1));
   problem.PrescribePressure("lower_z0", 0.0);
   problem.PrescribePressure("upper_z1", 0.0);
   ContactOptions contact;
   contact.gap_tolerance = 1.0;
   contact.pressure_tolerance = 1.0;
   problem.AddContact("lower_z1", "upper_z0", contact);
   NonlinearOptions nonlinear = Exact();
   nonlinear.linear.relative_tolerance = accuracy;
   problem.SetNonlinearOptions(nonlinear);
   TimeOptions times;
   times.end = 2.0 * long_time;
   times.step = 0.5 * long_time;
   TimeStepper stepper(problem, times);
   int iterations = 0;
   while (!stepper.Done())
   {
      iterations = MustStep(stepper).solve.newton;
   }
   return iterations;
}
} // namespace

TEST_CASE("Newton's method converges quadratically where surfaces slide")
{
   const int rough = Iterations(1e-5);
   const int fine = Iterations(1e-10);
   CAPTURE(rough, fine);
   CHECK(fine <= rough + 2);
   CHECK(fine <= 10);
}
