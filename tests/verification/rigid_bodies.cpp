// ranks: 1 2 3
// timeout: 600
//
// Surfaces that are tied to rigid bodies.
//
// A body turns exactly, whatever the angle: what is tied to it and nothing else
// turns along without stress. Drained and without Poisson's ratio, a beam under
// a force F along it and a moment M about a principal axis lengthens by
// F L / (E A) and bends into an arc, by the angle M L / (E I) and the sag
// M L^2 / (2 E I), with a parabolic displacement that elements of order 2 have.

#include "support/boxes.hpp"
#include "support/newton_iterates.hpp"
#include "support/temporary_directory.hpp"
#include "synovia/fem/node_positions.hpp"
#include "synovia/fem/rotation_vector.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/io/checkpoint.hpp"
#include "synovia/io/checkpoint_directory.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t long_time = 1e8;

RigidBodyOptions Fixed()
{
   RigidBodyOptions options;
   options.prescribed.fill(LoadCurve(0.0));
   return options;
}

SpaceOptions Space(Deformation deformation, int order = 2)
{
   SpaceOptions space;
   space.order = order;
   space.deformation = deformation;
   return space;
}

BoxOptions Block(int nz = 2)
{
   BoxOptions box;
   box.nx = 2;
   box.ny = 1;
   box.nz = nz;
   box.size_x = 0.8;
   box.size_y = 0.6;
   box.size_z = 1.5;
   return box;
}

/// A block with rigid bodies at its ends, drained at two sides.
struct Beam
{
   Beam(Deformation deformation, int order = 2, int nz = 2,
        LinearMethod method = LinearMethod::direct)
      : Beam(deformation, order, Block(nz), method)
   {
   }
   Beam(Deformation deformation, int order, const BoxOptions &box,
        LinearMethod method)
      : mesh(MakeBox(box)), problem(mesh, Space(deformation, order))
   {
      const SolidLaw *solid = &linear;
      if (deformation == Deformation::finite)
      {
         solid = &nonlinear;
      }
      problem.SetMaterial("body", *solid, fluid);
      for (const char *side : {"y0", "y1"})
      {
         problem.PrescribePressure(side, 0.0);
      }
      NonlinearOptions options;
      options.linear.method = method;
      options.linear.relative_tolerance = 1e-10;
      problem.SetNonlinearOptions(options);
   }

   void March(int steps, real_t step)
   {
      TimeOptions times;
      times.step = step;
      times.end = steps * step;
      times.cut_back = false;
      times.scheme = scheme;
      stepper = std::make_unique<TimeStepper>(problem, times);
      while (!stepper->Done())
      {
         Step();
      }
   }

   void Step()
   {
      const StepReport report = stepper->Step();
      INFO(report.reason);
      REQUIRE(report.converged);
      iterations = std::max(iterations, report.solve.most_linear);
      const bool guessed = !counts.empty();
      newton = std::max(newton, guessed ? report.solve.newton : 0);
      counts += " " + std::to_string(report.solve.newton);
   }

   const IsotropicElastic linear{0.7, 0.0};
   const NeoHookean nonlinear{0.7, 0.2};
   const ConstantPermeability fluid{4e-3};
   NamedMesh mesh;
   BiphasicProblem problem;
   TimeScheme scheme = TimeScheme::backward_euler;
   std::unique_ptr<TimeStepper> stepper;
   int iterations = 0;
   /// Newton's iterations of a step, but for the first, which has no guess.
   int newton = 0;
   /// Of all steps.
   std::string counts;
};

real_t Largest(const Vector &x)
{
   return MaxOverRanks(x.Size() > 0 ? x.Normlinf() : 0.0, MPI_COMM_WORLD);
}

// Largest distance of a node from where a motion of the whole takes it.
real_t DistanceFromTurned(Beam &beam, const RigidPose &pose,
                          const Point3 &reference)
{
   const RigidFrame frame(pose, Deformation::finite);
   const Vector positions = NodePositions(beam.problem.Spaces().Displacement());
   Vector error(beam.stepper->State().GetBlock(0));
   for (int dof = 0; dof < error.Size(); dof += 3)
   {
      const Point3 place{
         {positions[dof], positions[dof + 1], positions[dof + 2]}};
      const Point3 moved = frame.Displacement(Sum(place, -1.0, reference));
      for (int d = 0; d < 3; d++)
      {
         error[dof + d] -= moved[d];
      }
   }
   return Largest(error);
}

void CheckSame(const Point3 &a, const Point3 &b, real_t tolerance)
{
   CHECK(Length(Sum(a, -1.0, b)) <= tolerance);
}
} // namespace

TEST_CASE("A block between rigid bodies turns by 90 degrees without stress")
{
   const bool dragged = GENERATE(false, true);
   const LinearMethod method =
      GENERATE(LinearMethod::direct, LinearMethod::block_amg);
   CAPTURE(dragged, static_cast<int>(method));
   const int order = dragged ? 1 : 2;
   Beam beam(Deformation::finite, order, 2, method);
   const int steps = 8;
   const real_t angle = 0.5 * M_PI;
   const Point3 axis{{2.0 / 7.0, -3.0 / 7.0, 6.0 / 7.0}};
   RigidBodyOptions driven = Fixed();
   driven.reference = Point3{{0.3, -0.5, 0.2}};
   driven.prescribed[0] = Ramp(steps, 0.7);
   for (int d = 0; d < 3; d++)
   {
      driven.prescribed[d + 3] = Ramp(steps, angle * axis[d]);
   }
   if (dragged)
   {
      // The other end follows, though nothing is said of it.
      beam.problem.AddRigidBody("driven", {"z0"}, driven);
      beam.problem.AddRigidBody("follower", {"z1"}, RigidBodyOptions());
   }
   else
   {
      beam.problem.AddRigidBody("driven", {"z0", "z1"}, driven);
   }
   beam.March(steps, 1.0);
   const auto states = beam.problem.RigidBodyStates();
   REQUIRE(states.size() == (dragged ? 2 : 1));
   const RigidPose pose{
      {0.7, 0.0, 0.0, angle * axis[0], angle * axis[1], angle * axis[2]}};
   CHECK(DistanceFromTurned(beam, pose, *driven.reference) < 1e-10);
   CHECK(Largest(beam.stepper->State().GetBlock(1)) < 1e-10);
   for (const auto &state : states)
   {
      CAPTURE(state.name);
      CHECK(Length(state.force) < 1e-10);
      CHECK(Length(state.moment) < 1e-10);
      CheckSame(RotationOf(state.pose), RotationOf(pose), 1e-10);
   }
}

TEST_CASE("A body is guessed to turn along with what carries it")
{
   Beam beam(Deformation::finite, 1);
   const int steps = 3;
   const real_t angle = 0.8 * M_PI;
   RigidBodyOptions driven = Fixed();
   driven.reference = Point3{{0.3, -0.5, 0.2}};
   driven.prescribed[2] = Ramp(steps, 0.4);
   driven.prescribed[3] = Ramp(steps, angle);
   beam.problem.AddRigidBody("driven", {"z0"}, driven);
   beam.March(steps, 1.0);
   CHECK(beam.counts == " 0 0 0");
   const RigidPose pose{{0.0, 0.0, 0.4, angle, 0.0, 0.0}};
   CHECK(DistanceFromTurned(beam, pose, *driven.reference) < 1e-10);
}

TEST_CASE("A free body turns on and on, as far as it is dragged")
{
   // By one turn and a half, about an axis between those of the space.
   Beam beam(Deformation::finite, 1);
   const int steps = 24;
   const Point3 axis{{0.6, 0.0, 0.8}};
   RigidBodyOptions driven = Fixed();
   for (int d = 0; d < 3; d++)
   {
      driven.prescribed[d + 3] = Ramp(steps, 3.0 * M_PI * axis[d]);
   }
   beam.problem.AddRigidBody("driven", {"z0"}, driven);
   beam.problem.AddRigidBody("follower", {"z1"}, RigidBodyOptions());
   beam.March(steps, 1.0);
   const auto states = beam.problem.RigidBodyStates();
   CHECK(Length(RotationOf(states[0].pose)) == Approx(3.0 * M_PI));
   CHECK(Length(RotationOf(states[1].pose)) == Approx(M_PI));
   CHECK(Length(states[0].force) < 1e-9);
   CHECK(Length(states[0].moment) < 1e-9);
}

TEST_CASE("A force and a moment lengthen and bend a beam as beams do")
{
   const LinearMethod method =
      GENERATE(LinearMethod::direct, LinearMethod::block_amg);
   const bool sprung = GENERATE(false, true);
   CAPTURE(static_cast<int>(method), sprung);
   Beam beam(Deformation::infinitesimal, 2, 4, method);
   const BoxOptions box = Block();
   const real_t area = box.size_x * box.size_y;
   const real_t stretching = 0.7 * area / box.size_z;
   const real_t bending =
      0.7 * area * box.size_y * box.size_y / 12.0 / box.size_z;
   RigidBodyOptions end;
   end.load[2] = -0.02;
   end.load[3] = 0.003;
   if (sprung)
   {
      end.stiffness[2] = stretching;
   }
   beam.problem.AddRigidBody("base", {"z0"}, Fixed());
   beam.problem.AddRigidBody("end", {"z1"}, end);
   beam.March(1, long_time);
   const auto states = beam.problem.RigidBodyStates();
   const RigidPose &pose = states[1].pose;
   const real_t angle = 0.003 / bending;
   const real_t shared = sprung ? 0.5 : 1.0;
   CHECK(pose[2] == Approx(-0.02 / stretching * shared).epsilon(1e-7));
   CHECK(pose[3] == Approx(angle).epsilon(1e-7));
   // Turned about x, the beam along z goes towards -y.
   CHECK(pose[1] == Approx(-0.5 * angle * box.size_z).epsilon(1e-7));
   for (const int i : {0, 4, 5})
   {
      CHECK(std::abs(pose[i]) < 1e-8);
   }
   CheckSame(states[1].force, {{0.0, 0.0, -0.02 * shared}}, 1e-8 * 0.02);
   CheckSame(states[1].moment, {{0.003, 0.0, 0.0}}, 1e-8 * 0.003);
   CheckSame(states[0].force, {{0.0, 0.0, 0.02 * shared}}, 1e-8 * 0.02);
   CheckSame(states[0].moment, {{-0.003, 0.0, 0.0}}, 1e-8 * 0.003);
   CHECK(beam.iterations <= (method == LinearMethod::direct ? 3 : 40));
}

TEST_CASE("Loads of a body that turned far are balanced where they act")
{
   const bool follows = GENERATE(false, true);
   const LinearMethod method =
      GENERATE(LinearMethod::direct, LinearMethod::block_amg);
   CAPTURE(follows, static_cast<int>(method));
   Beam beam(Deformation::finite, 2, 3, method);
   const int steps = 10;
   RigidBodyOptions end;
   end.reference = Point3{{0.4, 0.5, 1.8}};
   const RigidPose loads{{0.002, -0.003, -0.004, 0.004, 0.002, 0.003}};
   for (int i = 0; i < 6; i++)
   {
      end.load[i] = Ramp(steps, loads[i]);
   }
   end.load_follows = follows;
   beam.problem.AddRigidBody("base", {"z0"}, Fixed());
   beam.problem.AddRigidBody("end", {"z1"}, end);
   beam.March(steps, 100.0 / steps);
   const auto states = beam.problem.RigidBodyStates();
   const RigidPose &pose = states[1].pose;
   CHECK(Length(RotationOf(pose)) > 0.5);
   Point3 force = TranslationOf(loads);
   Point3 moment = RotationOf(loads);
   if (follows)
   {
      const DenseMatrix turn = RotationMatrix(RotationOf(pose));
      force = Times(turn, force);
      moment = Times(turn, moment);
   }
   CheckSame(states[1].force, force, 1e-8 * Length(force));
   CheckSame(states[1].moment, moment, 1e-8 * Length(moment));
   // The base is at its center, where it was.
   const Point3 base{{0.4, 0.3, 0.0}};
   const Point3 arm =
      Sum(Sum(*end.reference, 1.0, TranslationOf(pose)), -1.0, base);
   const Point3 all_moments =
      Sum(Sum(states[1].moment, 1.0, Cross(arm, states[1].force)), 1.0,
          states[0].moment);
   const Point3 all_forces = Sum(states[0].force, 1.0, states[1].force);
   CHECK(Length(all_forces) <= 1e-8 * Length(force));
   CHECK(Length(all_moments) <= 1e-8 * Length(moment));
   CAPTURE(beam.iterations, beam.counts);
   CHECK(beam.newton <= 6);
   CHECK(beam.iterations <= 40);
}

TEST_CASE("Freedoms of rigid bodies don't cost multigrid iterations")
{
   // Beside a run in which all is prescribed where it went.
   BoxOptions box = Block(10);
   box.nx = 6;
   box.ny = 4;
   const auto solve = [&](const RigidBodyOptions &end, int &iterations)
   {
      Beam beam(Deformation::infinitesimal, 2, box, LinearMethod::block_amg);
      beam.problem.AddRigidBody("base", {"z0"}, Fixed());
      beam.problem.AddRigidBody("end", {"z1"}, end);
      beam.March(2, 10.0);
      iterations = beam.iterations;
      return beam.problem.RigidBodyStates()[1].pose;
   };
   RigidBodyOptions loaded;
   for (int i = 0; i < 6; i++)
   {
      loaded.load[i] = 0.001 * (i + 1);
   }
   int free_iterations = 0;
   const RigidPose pose = solve(loaded, free_iterations);
   RigidBodyOptions prescribed;
   for (int i = 0; i < 6; i++)
   {
      prescribed.prescribed[i] = pose[i];
   }
   int held_iterations = 0;
   solve(prescribed, held_iterations);
   CAPTURE(free_iterations, held_iterations);
   CHECK(held_iterations > 10);
   CHECK(free_iterations <= 1.1 * held_iterations);
}

TEST_CASE("Newton's method with rigid bodies converges quadratically")
{
   const auto make = [](int max_newton)
   {
      BoxOptions box = Block(3);
      box.ny = 2;
      auto beam = std::make_unique<Beam>(Deformation::finite, 2, box,
                                         LinearMethod::direct);
      beam->problem.SetNonlinearOptions(PlainNewton(max_newton));
      RigidBodyOptions end;
      end.reference = Point3{{0.4, 0.5, 1.8}};
      end.load[3] = Ramp(4.0, 0.004);
      end.load[4] = Ramp(4.0, -0.002);
      end.load[0] = Ramp(4.0, 0.002);
      beam->problem.AddRigidBody("base", {"z0"}, Fixed());
      beam->problem.AddRigidBody("end", {"z1"}, end);
      return beam;
   };
   TimeOptions times;
   times.end = 2.0;
   times.step = 1.0;
   const NewtonErrors errors = FindNewtonErrors(make, times, 2.0);
   CAPTURE(errors.u, errors.p);
   CHECK(errors.u.front() > 0.05);
   CHECK(GrowthOfDigits(errors.u) >= 1.8);
   CHECK(GrowthOfDigits(errors.p) >= 1.8);
}

TEST_CASE("A resumed run with rigid bodies equals the uninterrupted one")
{
   const TimeScheme scheme =
      GENERATE(TimeScheme::backward_euler, TimeScheme::sdirk33);
   CAPTURE(static_cast<int>(scheme));
   TimeOptions times;
   times.step = 2.5;
   times.end = 30.0;
   times.scheme = scheme;
   const auto make = []()
   {
      auto beam = std::make_unique<Beam>(Deformation::finite, 1, 3);
      RigidBodyOptions driven = Fixed();
      driven.prescribed[5] = Ramp(30.0, 0.75 * M_PI);
      driven.prescribed[3] = std::nullopt;
      RigidBodyOptions end;
      end.load[0] = Ramp(20.0, 0.002);
      end.load_follows = true;
      beam->problem.AddRigidBody("driven", {"z0"}, driven);
      beam->problem.AddRigidBody("end", {"z1"}, end);
      beam->problem.AddSprings({"x1"}, 0.05);
      return beam;
   };
   const auto go_on = [](TimeStepper &stepper, real_t until)
   {
      while (stepper.Time() < until - 1e-9)
      {
         const StepReport report = stepper.Step();
         INFO(report.reason);
         REQUIRE(report.converged);
      }
   };
   const auto whole = make();
   TimeStepper stepper(whole->problem, times);
   go_on(stepper, times.end);
   const TemporaryDirectory directory;
   {
      const auto half = make();
      TimeStepper first(half->problem, times);
      go_on(first, 20.0);
      WriteCheckpoint(directory.Path(), half->problem, first);
   }
   const auto rest = make();
   TimeStepper second(rest->problem, times);
   ReadCheckpoint(FindCheckpoint(directory.Path(), MPI_COMM_WORLD).file,
                  rest->problem, second);
   const auto before = rest->problem.RigidBodyStates();
   CHECK(RotationOf(before[0].pose)[2] == Approx(0.5 * M_PI));
   go_on(second, times.end);
   Vector difference(second.State());
   difference -= stepper.State();
   CHECK(Largest(difference) <= 1e-10 * Largest(stepper.State()));
   const auto states = rest->problem.RigidBodyStates();
   const auto expected = whole->problem.RigidBodyStates();
   for (size_t b = 0; b < states.size(); b++)
   {
      for (int i = 0; i < 6; i++)
      {
         CHECK(states[b].pose[i] == Approx(expected[b].pose[i]).margin(1e-10));
      }
      CheckSame(states[b].force, expected[b].force, 1e-10);
      CheckSame(states[b].moment, expected[b].moment, 1e-10);
   }
}

TEST_CASE("Planes of symmetry may cut what is tied to a rigid body")
{
   // Half of the beam, cut along x, of which the motion is a plane one; under
   // half of the loads it moves as the whole one.
   RigidBodyOptions end;
   end.reference = Point3{{0.0, 0.3, 1.5}};
   for (const int i : {0, 4, 5})
   {
      end.prescribed[i] = 0.0;
   }
   end.load[1] = Ramp(2.0, 0.002);
   end.load[2] = Ramp(2.0, -0.004);
   end.load[3] = Ramp(2.0, 0.002);
   Beam half(Deformation::finite);
   half.problem.PrescribeDisplacement("x0", 0, 0.0);
   half.problem.AddRigidBody("base", {"z0"}, Fixed());
   half.problem.AddRigidBody("end", {"z1"}, end);
   half.March(2, 10.0);
   BoxOptions box = Block();
   box.nx *= 2;
   box.size_x *= 2.0;
   Beam whole(Deformation::finite, 2, box, LinearMethod::direct);
   end.reference = Point3{{0.8, 0.3, 1.5}};
   for (const int i : {1, 2, 3})
   {
      const real_t load = end.load[i](2.0);
      end.load[i] = Ramp(2.0, 2.0 * load);
   }
   whole.problem.AddRigidBody("base", {"z0"}, Fixed());
   whole.problem.AddRigidBody("end", {"z1"}, end);
   whole.March(2, 10.0);
   const RigidPose a = half.problem.RigidBodyStates()[1].pose;
   const RigidPose b = whole.problem.RigidBodyStates()[1].pose;
   CHECK(std::abs(a[3]) > 0.05);
   for (int i = 0; i < 6; i++)
   {
      CHECK(a[i] == Approx(b[i]).margin(1e-7));
   }
}

TEST_CASE("What is prescribed for a rigid body and for its points must agree")
{
   Beam beam(Deformation::finite, 1);
   beam.problem.PrescribeDisplacement("x0", 0, Ramp(1.0, 0.1));
   beam.problem.AddRigidBody("base", {"z0"}, Fixed());
   CHECK_THROWS_WITH(beam.March(1, 1.0),
                     Catch::Contains("another displacement is prescribed than "
                                     "the body's, by up to 0.1 at t = 1"));
}
