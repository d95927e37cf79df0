// ranks: 1 2
// timeout: 600
//
// Coulomb's friction between drained blocks in finite deformation: an elastic
// block sticks below the angle of friction and slides above it, a block that
// is moved to and fro gives back what friction does not take, and a loaded pair
// that turns as a whole keeps its tractions.

#include "support/boxes.hpp"
#include "synovia/contact/contact_diagnostics.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/materials/permeabilities/constant_permeability.hpp"
#include "synovia/materials/solids/neo_hookean.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr int most_iterations = 9;
// Of a step; thousands of gel times.
constexpr real_t long_time = 1.0e9;
constexpr real_t mu = 0.3;

/// A layer that is held at its bottom, and a block on it, in plane strain.
class Blocks
{
public:
   Blocks() : mesh(Mesh()), problem(mesh, Space())
   {
      problem.SetMaterial("lower", layer, fluid);
      problem.SetMaterial("upper", block, fluid);
      for (const std::string body : {"lower_", "upper_"})
      {
         problem.PrescribeDisplacement(body + "y0", 1, 0.0);
         problem.PrescribeDisplacement(body + "y1", 1, 0.0);
      }
      problem.FixDisplacement("lower_z0");
      problem.PrescribePressure("lower_z0", 0.0);
      problem.PrescribePressure("upper_z1", 0.0);
      ContactOptions contact;
      contact.friction = {mu, 1.0};
      problem.AddContact("upper_z0", "lower_z1", contact);
   }

   const ContactPair &Pair() { return *problem.Operator().Pairs().front(); }
   FrictionDiagnostics Friction() { return Diagnose(Pair()).friction; }
   /// One step, of at most so many iterations.
   void Step(TimeStepper &stepper)
   {
      const StepReport report = stepper.Step();
      CAPTURE(report.reason, report.time / long_time, report.solve.newton);
      REQUIRE(report.converged);
      CHECK(report.failures == 0);
      CHECK(report.solve.newton <= most_iterations);
      const real_t now = Friction().dissipation;
      CHECK(now >= dissipation);
      dissipation = now;
   }

private:
   static NamedMesh Mesh()
   {
      BoxOptions lower;
      lower.nx = 8;
      lower.nz = 2;
      lower.size_x = 1.6;
      lower.size_y = 0.2;
      lower.size_z = 0.3;
      BoxOptions upper = lower;
      upper.nx = 5;
      upper.nz = 1;
      upper.size_x = 0.8;
      upper.size_z = 0.15;
      mfem::Mesh mesh = MakeStackMesh(lower, upper);
      for (int i = MakeBoxMesh(lower).GetNV(); i < mesh.GetNV(); i++)
      {
         mesh.GetVertex(i)[0] += 0.33;
      }
      return DistributeStack(mesh, MPI_COMM_WORLD);
   }
   static SpaceOptions Space()
   {
      SpaceOptions space;
      space.deformation = Deformation::finite;
      return space;
   }

   NamedMesh mesh;
   NeoHookean layer{0.5, 0.3};
   NeoHookean block{5.0, 0.3};
   ConstantPermeability fluid{4.0e-3};

public:
   BiphasicProblem problem;

private:
   real_t dissipation = 0.0;
};
} // namespace

TEST_CASE("An elastic block sticks below the angle of friction")
{
   constexpr real_t area = 0.8 * 0.2;
   constexpr real_t pressed = 0.02;
   constexpr real_t stiffness = 0.02;
   Blocks blocks;
   BiphasicProblem &problem = blocks.problem;
   problem.AddTraction("upper_z1", Vector({0.0, 0.0, -1.0}),
                       LoadCurve({0.0, 2.0 * long_time}, {0.0, pressed}));
   // What the bodies' weight does on an incline that gets steeper: the tangent
   // of its angle, over mu, is 0 until it rises to 1.3.
   const real_t pull = 1.3 * mu * pressed;
   problem.AddTraction(
      "upper_z1", Vector({1.0, 0.0, 0.0}),
      LoadCurve({0.0, 2.0 * long_time, 15.0 * long_time}, {0.0, 0.0, pull}));
   // A spring ends the slide.
   problem.AddSprings({"upper_z1"}, stiffness, Vector({1.0, 0.0, 0.0}));
   TimeOptions times;
   times.end = 15.0 * long_time;
   times.step = long_time;
   TimeStepper stepper(problem, times);
   real_t slipped = 0.0;
   while (!stepper.Done())
   {
      blocks.Step(stepper);
      const real_t slope =
         std::max<real_t>(0.0, stepper.Time() / long_time - 2.0) * 0.1;
      const Point3 spring =
         problem.Conditions().Springs()[0].Force(stepper.State().GetBlock(0));
      const real_t held = blocks.Friction().force[0];
      const real_t pulled = slope * mu * pressed * area;
      // The layer gives way under the block, and is not quite flat: pressure
      // holds the block, too.
      const real_t on_layer = Diagnose(blocks.Pair()).destination_force[0];
      CAPTURE(slope, spring[0], held, blocks.Friction().sliding);
      CHECK(on_layer - spring[0] == Approx(pulled).epsilon(1e-6).margin(1e-12));
      if (slope > 0.05 && slope < 0.95)
      {
         // Parts of the rim may slide.
         CHECK(blocks.Friction().sliding < 1.0);
         CHECK(std::abs(spring[0]) <= 0.17 * pulled);
         slipped = std::abs(spring[0]);
      }
      else if (slope > 1.15)
      {
         CHECK(blocks.Friction().sliding == 1.0);
         CHECK(held == Approx(mu * pressed * area).epsilon(3e-3));
      }
   }
   CHECK(slipped > 0.0);
}

TEST_CASE("What is moved to and fro gives back what friction does not take")
{
   Blocks blocks;
   BiphasicProblem &problem = blocks.problem;
   constexpr int steps = 16;
   constexpr real_t depth = 0.02;
   constexpr real_t way = 0.02;
   const real_t begin = 2.0 * long_time;
   const real_t quarter = steps * long_time;
   problem.PrescribeDisplacement(
      "upper_z1", 0,
      LoadCurve({0.0, begin, begin + quarter, begin + 3.0 * quarter,
                 begin + 5.0 * quarter},
                {0.0, 0.0, way, -way, way}));
   problem.PrescribeDisplacement("upper_z1", 1, 0.0);
   problem.PrescribeDisplacement("upper_z1", 2, Ramp(begin, -depth));
   TimeOptions times;
   times.end = begin + 5.0 * quarter;
   times.step = long_time;
   TimeStepper stepper(problem, times);
   real_t work = 0.0;
   real_t last_force = 0.0;
   real_t least_sliding = 1.0;
   real_t dissipated = 0.0;
   const real_t change = way / steps;
   while (!stepper.Done())
   {
      blocks.Step(stepper);
      const real_t force = blocks.Friction().force[0];
      const real_t t = (stepper.Time() - begin) / quarter;
      // From the first turning point to where it comes by again: the layer is
      // as it was.
      if (t < 1.0 + 1e-6)
      {
         dissipated = -blocks.Friction().dissipation;
      }
      else
      {
         const real_t motion = t < 3.0 + 1e-6 ? -change : change;
         // The force on the layer at the beginning and at the end of a step.
         work += 0.5 * (force + last_force) * motion;
         least_sliding = std::min(least_sliding, blocks.Friction().sliding);
      }
      last_force = force;
   }
   dissipated += blocks.Friction().dissipation;
   CAPTURE(work, dissipated, least_sliding);
   CHECK(dissipated > 0.0);
   CHECK(least_sliding < 0.5);
   CHECK(blocks.Friction().sliding == 1.0);
   CHECK(work == Approx(dissipated).epsilon(0.03));
}

namespace
{
/// Pressed and sheared, then turned about an axis.
class Sheared : public VectorCoefficient
{
public:
   explicit Sheared(int axis_) : VectorCoefficient(3), axis(axis_) {}
   void Eval(Vector &u, ElementTransformation &trans,
             const IntegrationPoint &ip) override
   {
      Vector x(3);
      trans.Transform(ip, x);
      const real_t t = GetTime() / long_time;
      const real_t pressed = std::min<real_t>(t / 2.0, 1.0);
      const real_t sheared =
         std::min<real_t>(std::max<real_t>(t - 2.0, 0.0) / 2.0, 1.0);
      Vector y(x);
      if (x[2] > 0.1)
      {
         y[2] -= 0.03 * pressed;
         y[0] += 0.02 * sheared;
      }
      const real_t angle = 0.5 * M_PI * std::max<real_t>(0.0, t - 4.0) / 8.0;
      const int i = (axis + 1) % 3;
      const int k = (axis + 2) % 3;
      u.SetSize(3);
      u[axis] = y[axis] - x[axis];
      u[i] = std::cos(angle) * y[i] - std::sin(angle) * y[k] - x[i];
      u[k] = std::sin(angle) * y[i] + std::cos(angle) * y[k] - x[k];
   }

private:
   int axis;
};
} // namespace

TEST_CASE("A pair that turns as a whole keeps its friction")
{
   const int axis = GENERATE(0, 1, 2);
   CAPTURE(axis);
   BoxOptions lower;
   lower.nx = 3;
   lower.ny = 2;
   lower.nz = 1;
   lower.size_x = 1.2;
   lower.size_z = 0.4;
   BoxOptions upper = lower;
   upper.nx = 2;
   upper.ny = 1;
   upper.size_x = 0.8;
   upper.size_y = 0.7;
   NamedMesh mesh = MakeStack(lower, upper);
   const NeoHookean lower_solid(0.5, 0.3);
   const NeoHookean upper_solid(0.7, 0.1);
   const ConstantPermeability fluid(4.0e-3);
   SpaceOptions space;
   space.deformation = Deformation::finite;
   BiphasicProblem problem(mesh, space);
   problem.SetMaterial("lower", lower_solid, fluid);
   problem.SetMaterial("upper", upper_solid, fluid);
   Sheared sheared(axis);
   Array<int> held(mesh.Boundary("lower_z0"));
   held.Append(mesh.Boundary("upper_z1"));
   problem.Conditions().PrescribeDisplacement(held, sheared);
   problem.PrescribePressure("lower_z0", 0.0);
   problem.PrescribePressure("upper_z1", 0.01);
   ContactOptions contact;
   contact.gap_tolerance = 1e-10;
   contact.friction = {mu, 1.0};
   problem.AddContact("upper_z0", "lower_z1", contact);
   NonlinearOptions nonlinear;
   nonlinear.linear.method = LinearMethod::direct;
   nonlinear.linear.relative_tolerance = 1e-10;
   problem.SetNonlinearOptions(nonlinear);
   TimeOptions times;
   times.end = 12.0 * long_time;
   times.step = 0.5 * long_time;
   TimeStepper stepper(problem, times);
   ContactDiagnostics before;
   while (!stepper.Done())
   {
      const StepReport report = stepper.Step();
      CAPTURE(report.reason, report.time / long_time, report.solve.newton);
      REQUIRE(report.converged);
      if (std::abs(stepper.Time() / long_time - 4.0) < 1e-6)
      {
         before = Diagnose(*problem.Operator().Pairs().front());
      }
   }
   const ContactDiagnostics after =
      Diagnose(*problem.Operator().Pairs().front());
   const int i = (axis + 1) % 3;
   const int k = (axis + 2) % 3;
   const auto compare = [&](const Point3 &now, const Point3 &then)
   {
      // What turns about the normal slips a little where it slid before: its
      // tractions turn with the normal, and only that.
      const real_t tolerance = (axis == 2 ? 1e-3 : 1e-4) * Length(then);
      CHECK(std::abs(now[axis] - then[axis]) <= tolerance);
      CHECK(std::abs(now[i] + then[k]) <= tolerance);
      CHECK(std::abs(now[k] - then[i]) <= tolerance);
   };
   CHECK(Length(before.friction.force) > 0.05 * Length(before.source_force));
   compare(after.source_force, before.source_force);
   compare(after.friction.force, before.friction.force);
   CHECK(after.friction.dissipation ==
         Approx(before.friction.dissipation).epsilon(axis == 2 ? 1e-2 : 1e-4));
   CHECK(Length(Sum(after.source_force, 1.0, after.destination_force)) <=
         1e-12 * Length(after.source_force));
}
