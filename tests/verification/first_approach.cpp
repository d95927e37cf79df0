// ranks: 1 2 3
//
// A round body that a force presses onto a layer starts where it touches,
// whatever the gap or the overlap as meshed: a rigid translation strains
// nothing, so that all that follows is the same.

#include "support/boxes.hpp"
#include "synovia/mesh/stack_bodies.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t force = 0.05;

struct Setup
{
   /// As meshed; negative for an overlap.
   real_t gap = 0.0;
   TimeScheme scheme = TimeScheme::backward_euler;
   bool adaptive = false;
   SearchConfiguration configuration = SearchConfiguration::reference;
   /// At the upper body's back, along the force (force / length); 0 for none.
   real_t spring = 0.0;
   /// Its coefficient, in finite deformation; 0 for the linear problem.
   real_t friction = 0.0;
};

/// What a run came to.
struct Outcome
{
   std::vector<FirstApproach::Move> moves;
   real_t travel = 0.0;
   real_t contact_force = 0.0;
   real_t peak_traction = 0.0;
   real_t peak_pressure = 0.0;
};

/// Two boxes of the same section.
Mesh MakeFlatBodies(real_t gap)
{
   BoxOptions box;
   box.nz = 2;
   Mesh mesh = MakeStackMesh(box, box);
   for (int i = mesh.GetNV() / 2; i < mesh.GetNV(); i++)
   {
      mesh.GetVertex(i)[2] += gap;
   }
   return mesh;
}

/// A layer, 0.5 high, and on top of it a box that is rounded underneath.
Mesh MakeBodies(const Setup &setup)
{
   if (setup.friction > 0.0)
   {
      return MakeFlatBodies(setup.gap);
   }

   BoxOptions layer;
   layer.nx = layer.ny = 4;
   layer.nz = 1;
   layer.size_x = layer.size_y = 2.0;
   layer.size_z = 0.5;
   BoxOptions round;
   round.nx = round.ny = 2;
   round.nz = 1;
   Mesh mesh = MakeStackMesh(layer, round);
   for (int i = MakeBoxMesh(layer).GetNV(); i < mesh.GetNV(); i++)
   {
      real_t *x = mesh.GetVertex(i);
      if (x[2] < 0.7)
      {
         // Touches first away from the middle.
         x[2] += 0.1 * std::pow(x[0] - 0.4, 2) + 0.1 * std::pow(x[1] - 0.3, 2);
      }
      x[0] += 0.45;
      x[1] += 0.55;
      x[2] += setup.gap;
   }
   return mesh;
}

Outcome Run(const Setup &setup, MPI_Comm comm = MPI_COMM_WORLD)
{
   Mesh mesh = MakeBodies(setup);
   NamedMesh bodies = DistributeStack(mesh, comm);
   const IsotropicElastic soft(0.5, 0.1);
   const IsotropicElastic stiff(50.0, 0.2);
   const NeoHookean deforming_soft(0.5, 0.1);
   const NeoHookean deforming_stiff(50.0, 0.2);
   const ConstantPermeability permeability(4e-3);
   const bool rough = setup.friction > 0.0;
   SpaceOptions space;
   space.deformation = rough ? Deformation::finite : Deformation::infinitesimal;
   BiphasicProblem problem(bodies, space);
   const auto solid = [rough](const SolidLaw &linear,
                              const SolidLaw &deforming) -> const SolidLaw &
   { return rough ? deforming : linear; };
   problem.SetMaterial("lower", solid(soft, deforming_soft), permeability);
   problem.SetMaterial("upper", solid(stiff, deforming_stiff), permeability);
   if (rough)
   {
      for (const std::string body : {"lower_", "upper_"})
      {
         for (const std::string end : {"0", "1"})
         {
            problem.PrescribeDisplacement(body + "x" + end, 0, 0.0);
            problem.PrescribeDisplacement(body + "y" + end, 1, 0.0);
         }
      }
   }
   problem.FixDisplacement("lower_z0");
   problem.PrescribeDisplacement("upper_z1", 0, 0.0);
   problem.PrescribeDisplacement("upper_z1", 1, 0.0);
   problem.PrescribePressure("upper_z1", 0.0);
   problem.DriveByForce({"upper_z1"}, Vector({0.0, 0.0, -1.0}),
                        Ramp(10.0, force));
   if (setup.spring > 0.0)
   {
      problem.AddSprings({"upper_z1"}, setup.spring, Vector({0.0, 0.0, 1.0}));
   }
   ContactOptions contact;
   contact.configuration =
      rough ? SearchConfiguration::current : setup.configuration;
   contact.friction.coefficient = setup.friction;
   problem.AddContact("upper_z0", "lower_z1", contact, "pair");
   NonlinearOptions nonlinear;
   nonlinear.linear.relative_tolerance = 1e-10;
   problem.SetNonlinearOptions(nonlinear);
   TimeOptions times;
   times.step = 4.0;
   times.end = 16.0;
   times.scheme = setup.scheme;
   times.adaptive = setup.adaptive;
   TimeStepper stepper(problem, times);
   Outcome outcome;
   outcome.moves = problem.Operator().Start().moves;
   while (!stepper.Done())
   {
      const StepReport report = stepper.Step();
      INFO(report.reason);
      REQUIRE(report.converged);
   }
   const ContactDiagnostics now = Diagnose(*problem.Operator().Pairs().front());
   outcome.travel = problem.Operator()
                       .Equations()
                       .Rigid()
                       .GetTravel(stepper.State().GetBlock(0))
                       .front()
                       .distance;
   outcome.contact_force = -now.destination_force[2];
   outcome.peak_traction = now.peak_traction;
   outcome.peak_pressure = now.peak_pressure;
   return outcome;
}
} // namespace

TEST_CASE("Gaps are closed and overlaps pressed out before the first step")
{
   Setup setup;
   setup.scheme = GENERATE(TimeScheme::backward_euler, TimeScheme::sdirk23,
                           TimeScheme::sdirk33);
   setup.adaptive = GENERATE(false, true);
   const Outcome touching = Run(setup);
   CHECK(touching.contact_force == Approx(force).epsilon(1e-8));
   // The last one is beyond the search radius.
   for (const real_t gap : {-0.04, 0.05, 1.5})
   {
      setup.gap = gap;
      const Outcome there = Run(setup);
      CAPTURE(gap, setup.adaptive, touching.travel, there.travel);
      REQUIRE(there.moves.size() == 1);
      CHECK(there.moves.front().name == "upper_z1");
      CHECK(there.moves.front().pair == "pair");
      // Adaptive steps may go another way by round-off.
      const real_t tolerance = setup.adaptive ? 2e-2 : 1e-6;
      CHECK(there.contact_force == Approx(force).epsilon(1e-8));
      CHECK(there.travel - gap == Approx(touching.travel).epsilon(tolerance));
      CHECK(there.peak_traction ==
            Approx(touching.peak_traction).epsilon(tolerance));
      CHECK(there.peak_pressure ==
            Approx(touching.peak_pressure).epsilon(tolerance));
   }
}

TEST_CASE("A rough body starts there, and has not slid on the way")
{
   // It is flat: as large as what it presses on, it only goes down.
   Setup setup;
   setup.friction = 0.2;
   const Outcome touching = Run(setup);
   CHECK(touching.contact_force == Approx(force).epsilon(1e-8));
   for (const real_t gap : {-0.04, 0.05})
   {
      setup.gap = gap;
      const Outcome there = Run(setup);
      CAPTURE(gap, touching.travel, there.travel);
      REQUIRE(there.moves.size() == 1);
      CHECK(there.contact_force == Approx(force).epsilon(1e-8));
      CHECK(there.travel - gap == Approx(touching.travel).epsilon(1e-6));
      CHECK(there.peak_traction ==
            Approx(touching.peak_traction).epsilon(1e-6));
   }
}

TEST_CASE("The search in each step starts from there too")
{
   Setup setup;
   setup.configuration = SearchConfiguration::current;
   setup.gap = -0.04;
   const Outcome overlapping = Run(setup);
   setup.gap = 1.5;
   const Outcome far = Run(setup);
   CHECK(overlapping.moves.front().distance < 0.0);
   CHECK(far.moves.front().distance > 1.5);
   CHECK(far.contact_force == Approx(force).epsilon(1e-8));
   CHECK(far.travel - 1.5 == Approx(overlapping.travel + 0.04).epsilon(1e-6));
   CHECK(far.peak_traction == Approx(overlapping.peak_traction).epsilon(1e-6));
}

TEST_CASE("Ranks don't matter")
{
   Setup setup;
   setup.scheme = TimeScheme::sdirk23;
   setup.gap = GENERATE(-0.04, 1.5);
   const Outcome here = Run(setup);
   const Outcome alone = Run(setup, MPI_COMM_SELF);
   REQUIRE(here.moves.size() == 1);
   REQUIRE(alone.moves.size() == 1);
   CHECK(here.moves.front().distance ==
         Approx(alone.moves.front().distance).epsilon(1e-9));
   CHECK(here.travel == Approx(alone.travel).epsilon(1e-7));
   CHECK(here.peak_traction == Approx(alone.peak_traction).epsilon(1e-6));
   CHECK(here.peak_pressure == Approx(alone.peak_pressure).epsilon(1e-6));
}

TEST_CASE("A body that springs hold along the force is not moved")
{
   Setup setup;
   setup.spring = 0.5;
   setup.gap = 0.02;
   const Outcome held = Run(setup);
   CHECK(held.moves.empty());
   CHECK(held.travel > setup.gap);
   CHECK(held.contact_force ==
         Approx(force - setup.spring * held.travel).epsilon(1e-6));
}

TEST_CASE("What the body meets goes with it, unless it is held")
{
   // Three cubes on top of each other, on rollers at their sides; after a long
   // time each is shorter by F/A h/E.
   constexpr real_t young = 0.7;
   constexpr real_t load = 0.007;
   const real_t bottoms[3] = {0.0, 1.1, 2.15};
   BoxOptions cube;
   cube.nx = cube.ny = 2;
   cube.nz = 1;
   const Mesh cubes[3] = {MakeBoxMesh(cube), MakeBoxMesh(cube),
                          MakeBoxMesh(cube)};
   StackedBodies stack = StackBodies({&cubes[0], &cubes[1], &cubes[2]});
   NameTable regions;
   NameTable boundaries;
   const std::string names[3] = {"low", "middle", "high"};
   const char *const sides[6] = {"_z0", "_y0", "_x1", "_y1", "_x0", "_z1"};
   const int vertices = cubes[0].GetNV();
   for (int i = 0; i < stack.mesh.GetNV(); i++)
   {
      stack.mesh.GetVertex(i)[2] += bottoms[i / vertices];
   }
   for (int b = 0; b < 3; b++)
   {
      regions[names[b]] = {1 + stack.region_offsets[b]};
      for (int i = 0; i < 6; i++)
      {
         boundaries[names[b] + sides[i]] = {1 + i + stack.boundary_offsets[b]};
      }
   }
   NamedMesh bodies =
      DistributeMesh(stack.mesh, regions, boundaries, MPI_COMM_WORLD);
   const IsotropicElastic solid(young, 0.0);
   const ConstantPermeability permeability(4e-3);
   BiphasicProblem problem(bodies, SpaceOptions());
   for (const std::string &name : names)
   {
      problem.SetMaterial(name, solid, permeability);
      problem.PrescribeDisplacement(name + "_x0", 0, 0.0);
      problem.PrescribeDisplacement(name + "_x1", 0, 0.0);
      problem.PrescribeDisplacement(name + "_y0", 1, 0.0);
      problem.PrescribeDisplacement(name + "_y1", 1, 0.0);
   }
   problem.PrescribeDisplacement("low_z0", 2, 0.0);
   problem.PrescribePressure("high_z1", 0.0);
   problem.DriveByForce({"high_z1"}, Vector({0.0, 0.0, -1.0}), load);
   problem.AddContact("high_z0", "middle_z1", ContactOptions(), "above");
   problem.AddContact("low_z1", "middle_z0", ContactOptions(), "below");
   TimeOptions times;
   times.step = times.end = 1e8;
   TimeStepper stepper(problem, times);
   const FirstApproach &start = problem.Operator().Start();
   REQUIRE(start.moves.size() == 2);
   CHECK(start.moves[0].pair == "above");
   CHECK(start.moves[0].distance == Approx(0.05));
   CHECK(start.moves[1].pair == "below");
   CHECK(start.moves[1].distance == Approx(0.1));
   CHECK(ToText(start.moves[1]) ==
         "what the force on \"high_z1\" moves was moved by 0.1 along it, until "
         "it touches: contact pair \"below\"");
   const StepReport report = stepper.Step();
   INFO(report.reason);
   REQUIRE(report.converged);
   CHECK(problem.Operator()
            .Equations()
            .Rigid()
            .GetTravel(stepper.State().GetBlock(0))
            .front()
            .distance == Approx(0.15 + 3.0 * load / young).epsilon(1e-5));
}
