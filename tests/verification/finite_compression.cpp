// ranks: 1 2
// timeout: 300
//
// Confined and unconfined compression in finite deformation against references
// on which two other programs agree to seven digits. Units mm, N, s, MPa:
// E = 0.5, nu = 0.1, permeability 4e-3, one law each with constant spatial
// permeability and with that of Holmes & Mow (beta 0.5, M 2, alpha 2, solid
// fraction 0.2).
//
// Confined: height 1, the drained top moves by -0.3 within 500 s, base and
// sides are sealed and don't move along their normals. Unconfined: radius 1.5,
// strain -0.2 within 500 s between frictionless sealed platens.
//
// And what flows out of bodies over a run is what their volume loses.

#include "support/boxes.hpp"
#include "support/reference_table.hpp"
#include "support/round_meshes.hpp"
#include "synovia/contact/contact_diagnostics.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/materials/permeabilities/constant_permeability.hpp"
#include "synovia/materials/permeabilities/holmes_mow_permeability.hpp"
#include "synovia/materials/solids/holmes_mow.hpp"
#include "synovia/materials/solids/neo_hookean.hpp"
#include "synovia/synovia.hpp"
#include "synovia/time/sdirk2_solver.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t reference_tolerance = 2e-3;
const std::vector<real_t> times = {50.0,  100.0, 250.0, 500.0,
                                   550.0, 700.0, 1000.0};

struct Laws
{
   const NeoHookean neo_hookean{0.5, 0.1};
   const ConstantPermeability constant{4.0e-3};
   const HolmesMow holmes_mow{0.5, 0.1, 0.5};
   const HolmesMowPermeability closing{4.0e-3, 2.0, 2.0, 0.2};

   void SetTo(BiphasicProblem &problem, bool stiffening) const
   {
      if (stiffening)
      {
         problem.SetMaterial("body", holmes_mow, closing);
      }
      else
      {
         problem.SetMaterial("body", neo_hookean, constant);
      }
   }
};

SpaceOptions Finite(int order)
{
   SpaceOptions space;
   space.order = order;
   space.deformation = Deformation::finite;
   return space;
}

TimeOptions Times(real_t step, TimeScheme scheme)
{
   TimeOptions options;
   options.end = 550.0;
   options.step = step;
   options.scheme = scheme;
   return options;
}

// The largest value of a field's component among the vertices @a here.
real_t LargestAt(const ParMesh &mesh, const ParGridFunction &field, int width,
                 int component, const std::function<bool(const real_t *)> &here)
{
   real_t largest = -std::numeric_limits<real_t>::infinity();
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

bool IsOneOf(const std::vector<real_t> &wanted, real_t t)
{
   return std::any_of(wanted.begin(), wanted.end(),
                      [t](real_t when) { return std::abs(t - when) < 1e-9; });
}

// By 30 %, drained at the top.
void Confine(BiphasicProblem &problem)
{
   for (const char *side : {"x0", "x1"})
   {
      problem.PrescribeDisplacement(side, 0, 0.0);
   }
   for (const char *side : {"y0", "y1"})
   {
      problem.PrescribeDisplacement(side, 1, 0.0);
   }
   problem.PrescribeDisplacement("z0", 2, 0.0);
   problem.PrescribeDisplacement("z1", 2, Ramp(500.0, -0.3));
   problem.PrescribePressure("z1", 0.0);
}

// Marches a column of height 1 and compares it with the reference.
void CompressColumn(const BoxOptions &box, int order, bool stiffening,
                    const TimeOptions &options, real_t tolerance)
{
   NamedMesh mesh = MakeBox(box);
   const Laws laws;
   BiphasicProblem problem(mesh, Finite(order));
   laws.SetTo(problem, stiffening);
   Confine(problem);
   TimeStepper stepper(problem, options);
   const ReferenceTable reference(
      stiffening ? "finite_confined_holmesmow.csv"
                 : "finite_confined_neohookean_constant.csv");
   int compared = 0;
   while (!stepper.Done())
   {
      const StepReport report = stepper.Step();
      INFO(report.reason);
      REQUIRE(report.converged);
      CHECK(report.solve.newton <= 8 * report.solves);
      const real_t t = stepper.Time();
      if (!IsOneOf(times, t))
      {
         continue;
      }
      const real_t area = box.size_x * box.size_y;
      const real_t stress =
         problem.Reaction(problem.Supports().back())[2] / area;
      const real_t middle =
         LargestAt(mesh.Get(), stepper.Displacement(), 3, 2,
                   [](const real_t *x) { return std::abs(x[2] - 0.5) < 1e-9; });
      const real_t base =
         LargestAt(mesh.Get(), stepper.Pressure(), 1, 0,
                   [](const real_t *x) { return std::abs(x[2]) < 1e-9; });
      CAPTURE(t, order, stiffening);
      CHECK(stress ==
            Approx(reference.Find({{"t", t}}, "stress")).epsilon(tolerance));
      CHECK(middle ==
            Approx(reference.Find({{"t", t}}, "u_mid")).epsilon(tolerance));
      CHECK(base ==
            Approx(reference.Find({{"t", t}}, "p_base"))
               .epsilon(0.0)
               .margin(tolerance * reference.Find({{"t", 500.0}}, "p_base")));
      compared++;
   }
   CHECK(compared == 5);
}
} // namespace

TEST_CASE("Confined compression by 30 % meets the references, hexahedra of "
          "order 2")
{
   BoxOptions box;
   box.nz = 40;
   box.size_x = box.size_y = 0.1;
   CompressColumn(box, 2, GENERATE(false, true),
                  Times(6.25, TimeScheme::sdirk33), reference_tolerance);
}

TEST_CASE("Confined compression by 30 % within 1 % with order 1")
{
   BoxOptions box;
   box.nz = 40;
   box.size_x = box.size_y = 0.1;
   box.type = GENERATE(Element::HEXAHEDRON, Element::TETRAHEDRON);
   CompressColumn(box, 1, true, Times(6.25, TimeScheme::sdirk23), 1e-2);
}

namespace
{
/// The bodies of a problem, of which schemes integrate what flows out along
/// with the state: its last entry.
class WithOutflow : public TimeDependentOperator
{
public:
   explicit WithOutflow(BiphasicOperator &op_)
      : TimeDependentOperator(op_.Height() + 1, 0.0, IMPLICIT), op(op_)
   {
   }
   void ImplicitSolve(const real_t dt, const Vector &x, Vector &k) override
   {
      const Vector state(const_cast<Vector &>(x), 0, op.Height());
      Vector rate;
      op.SetTime(GetTime());
      op.ImplicitSolve(dt, state, rate);
      k.SetSize(Height());
      k.SetVector(rate, 0);
      k[op.Height()] = op.Balance().outflow;
   }

private:
   BiphasicOperator &op;
};

/// Volumes since the beginning.
struct Exchange
{
   real_t drained;
   real_t lost;
};

/// Of the deformed bodies.
real_t Volume(BiphasicProblem &problem, const Vector &u)
{
   ParFiniteElementSpace &space = problem.Spaces().Displacement();
   ParGridFunction displacement(&space);
   displacement.SetFromTrueDofs(u);
   real_t volume = 0.0;
   for (int i = 0; i < space.GetNE(); i++)
   {
      ElementTransformation &trans = *space.GetElementTransformation(i);
      // Exact on elements with parallel sides.
      const IntegrationRule &rule =
         IntRules.Get(trans.GetGeometryType(), 3 * problem.Spaces().Order());
      for (const IntegrationPoint &ip : rule)
      {
         trans.SetIntPoint(&ip);
         DenseMatrix gradient;
         displacement.GetVectorGradient(trans, gradient);
         for (int d = 0; d < 3; d++)
         {
            gradient(d, d) += 1.0;
         }
         volume += ip.weight * trans.Weight() * gradient.Det();
      }
   }
   return SumOverRanks(volume, problem.Spaces().GetComm());
}

/// Marches for 550 s in steps of 100 s; after each of them.
std::vector<Exchange> FindExchange(BiphasicProblem &problem, ODESolver &solver)
{
   BiphasicOperator &op = problem.Operator();
   const int dofs = problem.Spaces().Offsets().Last();
   Vector u(problem.Spaces().Offsets()[1]);
   u = 0.0;
   Vector conserved;
   op.Equations().Bodies().GetConserved(u, conserved);
   WithOutflow with_outflow(op);
   solver.Init(with_outflow);
   Vector state(with_outflow.Height());
   state = 0.0;
   state.SetVector(conserved, dofs);
   const real_t volume = Volume(problem, u);
   std::vector<Exchange> exchange;
   for (real_t t = 0.0; t < 549.0;)
   {
      const Vector dofs_now(state, 0, dofs);
      op.BeginStep(dofs_now);
      real_t dt = std::min<real_t>(100.0, 550.0 - t);
      solver.Step(state, t, dt);
      INFO(op.Report().reason);
      REQUIRE(op.Report().converged);
      op.AcceptStep();
      for (int k = 0; k < u.Size(); k++)
      {
         u[k] = state[k];
      }
      exchange.push_back({state[op.Height()], volume - Volume(problem, u)});
   }
   return exchange;
}

std::unique_ptr<ODESolver> MakeSolver(TimeScheme scheme)
{
   switch (scheme)
   {
   case TimeScheme::sdirk23:
      return std::make_unique<Sdirk2Solver>();
   case TimeScheme::sdirk33:
      return std::make_unique<SDIRK33Solver>();
   default:
      return std::make_unique<BackwardEulerSolver>();
   }
}

constexpr real_t lost_at_most = 1e-9;
} // namespace

TEST_CASE("What flows out of a column is what its volume loses")
{
   BoxOptions box;
   box.nz = 8;
   box.type = GENERATE(Element::HEXAHEDRON, Element::TETRAHEDRON);
   const int order = GENERATE(1, 2);
   const TimeScheme scheme = GENERATE(TimeScheme::backward_euler,
                                      TimeScheme::sdirk23, TimeScheme::sdirk33);
   CAPTURE(static_cast<int>(box.type), order, static_cast<int>(scheme));
   NamedMesh mesh = MakeBox(box);
   const Laws laws;
   BiphasicProblem problem(mesh, Finite(order));
   laws.SetTo(problem, true);
   Confine(problem);
   const std::unique_ptr<ODESolver> solver = MakeSolver(scheme);
   const std::vector<Exchange> exchange = FindExchange(problem, *solver);
   REQUIRE(exchange.size() == 6);
   for (const Exchange &volumes : exchange)
   {
      CHECK(std::abs(volumes.drained - volumes.lost) <=
            lost_at_most * volumes.lost);
   }
   CHECK(exchange.back().drained == Approx(0.3).epsilon(lost_at_most));
}

// A block is pressed into a wider one, of which what it leaves free drains; it
// drains at its sides, and slides.
TEST_CASE("What flows out of blocks in contact is what their volume loses")
{
   const TimeScheme scheme = GENERATE(TimeScheme::backward_euler,
                                      TimeScheme::sdirk23, TimeScheme::sdirk33);
   CAPTURE(static_cast<int>(scheme));
   BoxOptions lower;
   lower.nx = 3;
   lower.ny = 2;
   lower.nz = 2;
   lower.size_y = 0.8;
   lower.size_z = 0.5;
   BoxOptions upper = lower;
   upper.nx = 2;
   upper.size_x = 0.6;
   upper.size_y = 0.5;
   NamedMesh mesh = MakeStack(lower, upper);
   const Laws laws;
   BiphasicProblem problem(mesh, Finite(2));
   problem.SetMaterial("lower", laws.neo_hookean, laws.constant);
   problem.SetMaterial("upper", laws.holmes_mow, laws.closing);
   problem.FixDisplacement("lower_z0");
   problem.PrescribeDisplacement("upper_z1", 0, Ramp(500.0, 0.1));
   problem.PrescribeDisplacement("upper_z1", 1, 0.0);
   problem.PrescribeDisplacement("upper_z1", 2, Ramp(500.0, -0.15));
   problem.PrescribePressure("upper_x1", 0.0);
   problem.PrescribePressure("upper_y1", 0.0);
   problem.AddContact("lower_z1", "upper_z0");
   const std::unique_ptr<ODESolver> solver = MakeSolver(scheme);
   const std::vector<Exchange> exchange = FindExchange(problem, *solver);
   REQUIRE(exchange.size() == 6);
   for (const Exchange &volumes : exchange)
   {
      CHECK(volumes.lost > 1e-3);
      CHECK(std::abs(volumes.drained - volumes.lost) <=
            lost_at_most * volumes.lost);
   }
   // Fluid passes from one block to the other.
   CHECK(
      std::abs(Diagnose(*problem.Operator().Pairs().front()).fluid_exchange) >
      1e-6);
}

TEST_CASE("A step that would turn elements inside out fails and says where")
{
   BoxOptions box;
   box.nz = 4;
   NamedMesh mesh = MakeBox(box);
   const Laws laws;
   BiphasicProblem problem(mesh, Finite(1));
   laws.SetTo(problem, false);
   problem.FixDisplacement("z0");
   problem.FixDisplacement("z1");
   problem.PrescribeDisplacement("z1", 2, Ramp(1.0, -1.2));
   problem.PrescribePressure("x0", 0.0);
   TimeOptions options;
   options.end = 1.0;
   options.step = 1.0;
   options.cut_back = false;
   TimeStepper stepper(problem, options);
   const StepReport report = stepper.Step();
   CHECK_FALSE(report.converged);
   CHECK_THAT(report.reason, Catch::Contains("inside out") &&
                                Catch::Contains("\"body\"") &&
                                Catch::Contains("det F = -"));
}

TEST_CASE("Finite deformation refuses laws of infinitesimal strain")
{
   BoxOptions box;
   NamedMesh mesh = MakeBox(box);
   const IsotropicElastic linear(0.5, 0.1);
   const ConstantPermeability constant(4.0e-3);
   BiphasicProblem problem(mesh, Finite(2));
   problem.SetMaterial("body", linear, constant);
   problem.FixDisplacement("z0");
   CHECK_THROWS_WITH(problem.Operator(),
                     Catch::Contains("the solid of \"body\" is a law of "
                                     "infinitesimal deformation"));
}

TEST_CASE("Unconfined compression by 20 % meets the references")
{
   const bool stiffening = GENERATE(false, true);
   constexpr real_t radius = 1.5;
   constexpr real_t height = 0.25;
   RoundOptions disc;
   disc.radius = radius;
   disc.core = 2;
   disc.shells = 3;
   disc.grading = 1.5;
   disc.order = 3;
   disc.height = height;
   NamedMesh mesh = MakeQuarterCylinder(disc);
   const Laws laws;
   BiphasicProblem problem(mesh, Finite(3));
   laws.SetTo(problem, stiffening);
   problem.PrescribeDisplacement("x0", 0, 0.0);
   problem.PrescribeDisplacement("y0", 1, 0.0);
   problem.PrescribeDisplacement("z0", 2, 0.0);
   problem.PrescribePressure("side", 0.0);
   problem.PrescribeDisplacement("z1", 2, Ramp(500.0, -0.2 * height));
   TimeStepper stepper(problem, Times(25.0, TimeScheme::sdirk33));
   const ReferenceTable reference(
      stiffening ? "finite_unconfined_holmesmow.csv"
                 : "finite_unconfined_neohookean_constant.csv");
   int compared = 0;
   while (!stepper.Done())
   {
      const StepReport report = stepper.Step();
      INFO(report.reason);
      REQUIRE(report.converged);
      const real_t t = stepper.Time();
      if (!IsOneOf(times, t))
      {
         continue;
      }
      const real_t area = 0.25 * M_PI * radius * radius;
      const real_t stress =
         problem.Reaction(problem.Supports().back())[2] / area;
      const real_t side = LargestAt(mesh.Get(), stepper.Displacement(), 3, 0,
                                    [](const real_t *x) {
                                       return std::abs(x[0] - radius) < 1e-9 &&
                                              std::abs(x[1]) < 1e-9;
                                    });
      const real_t axis = LargestAt(mesh.Get(), stepper.Pressure(), 1, 0,
                                    [](const real_t *x)
                                    { return std::hypot(x[0], x[1]) < 1e-9; });
      CAPTURE(t, stiffening);
      CHECK(stress == Approx(reference.Find({{"t", t}}, "mean_stress"))
                         .epsilon(reference_tolerance));
      CHECK(side == Approx(reference.Find({{"t", t}}, "u_r_side"))
                       .epsilon(reference_tolerance));
      CHECK(axis == Approx(reference.Find({{"t", t}}, "p_axis"))
                       .epsilon(0.0)
                       .margin(reference_tolerance *
                               reference.Find({{"t", 500.0}}, "p_axis")));
      compared++;
   }
   CHECK(compared == 5);
}
