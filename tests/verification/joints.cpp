// ranks: 1 2 3
// timeout: 600
//
// Joints whose coordinates are prescribed. About axes of space a joint with all
// angles prescribed is a rigid body with a prescribed rotation; where all six
// coordinates are, the distal body goes with the proximal one; and what drives
// flexion alone is a moment about the axis of flexion, with neither a force nor
// a moment about the other axes.

#include "support/boxes.hpp"
#include "support/temporary_directory.hpp"
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
SpaceOptions Space(Deformation deformation)
{
   SpaceOptions space;
   space.order = 1;
   space.deformation = deformation;
   return space;
}

RigidBodyOptions Fixed()
{
   RigidBodyOptions options;
   options.prescribed.fill(LoadCurve(0.0));
   return options;
}

BoxOptions Block()
{
   BoxOptions box;
   box.nx = 2;
   box.ny = 1;
   box.nz = 3;
   box.size_x = 0.8;
   box.size_y = 0.6;
   box.size_z = 1.5;
   return box;
}

/// A block between the rigid bodies "femur", above, and "tibia".
struct Knee
{
   Knee(Deformation deformation, LinearMethod method)
      : mesh(MakeBox(Block())), problem(mesh, Space(deformation))
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
      options.linear.method = method;
      options.linear.relative_tolerance = 1e-10;
   }

   void AddBodies(const RigidBodyOptions &femur, const RigidBodyOptions &tibia)
   {
      problem.AddRigidBody("femur", {"z1"}, femur);
      problem.AddRigidBody("tibia", {"z0"}, tibia);
   }

   void Step(TimeStepper &stepper)
   {
      const StepReport report = stepper.Step();
      INFO(report.reason);
      REQUIRE(report.converged);
      iterations = std::max(iterations, report.solve.most_linear);
      newton = std::max(newton, report.solve.newton);
   }

   TimeOptions Times(int steps, real_t step)
   {
      problem.SetNonlinearOptions(options);
      TimeOptions times;
      times.step = step;
      times.end = steps * step;
      times.cut_back = false;
      return times;
   }

   void March(int steps, real_t step)
   {
      TimeStepper stepper(problem, Times(steps, step));
      while (!stepper.Done())
      {
         Step(stepper);
      }
      state = stepper.State();
   }

   const IsotropicElastic linear{0.7, 0.2};
   const NeoHookean nonlinear{0.7, 0.2};
   const ConstantPermeability fluid{4e-3};
   NamedMesh mesh;
   BiphasicProblem problem;
   NonlinearOptions options;
   Vector state;
   int iterations = 0;
   int newton = 0;
};

/// Right, with axes of the femur and the tibia along those of space.
Joint Right(const std::string &proximal, const Point3 &origin)
{
   Joint joint;
   joint.name = "knee";
   joint.proximal.body = proximal;
   joint.proximal.origin = origin;
   joint.distal.body = "tibia";
   joint.distal.origin = origin;
   return joint;
}

real_t Largest(const Vector &x)
{
   return MaxOverRanks(x.Size() > 0 ? x.Normlinf() : 0.0, MPI_COMM_WORLD);
}

void CheckSame(const Point3 &a, const Point3 &b, real_t tolerance)
{
   CHECK(Length(Sum(a, -1.0, b)) <= tolerance);
}
} // namespace

TEST_CASE("A joint in space prescribes what a rigid body's rotation does")
{
   const Deformation deformation =
      GENERATE(Deformation::infinitesimal, Deformation::finite);
   const LinearMethod method =
      GENERATE(LinearMethod::direct, LinearMethod::block_amg);
   CAPTURE(static_cast<int>(deformation), static_cast<int>(method));
   const bool finite = deformation == Deformation::finite;
   const real_t angle = finite ? 0.8 : 0.01;
   RigidBodyOptions tibia;
   tibia.reference = Point3{{0.4, 0.2, 0.1}};
   tibia.load[0] = Ramp(5.0, 0.004);
   Knee driven(deformation, method);
   driven.AddBodies(Fixed(), tibia);
   Joint knee = Right("", {{0.4, 0.2, 0.1}});
   knee.prescribed[0] = Ramp(5.0, angle);
   knee.prescribed[1] = knee.prescribed[2] = 0.0;
   driven.problem.AddJoint(knee);
   driven.March(5, 4.0);

   for (int d = 3; d < 6; d++)
   {
      tibia.prescribed[d] = d == 3 ? Ramp(5.0, -angle) : LoadCurve(0.0);
   }
   Knee turned(deformation, method);
   turned.AddBodies(Fixed(), tibia);
   turned.March(5, 4.0);

   const auto joint = driven.problem.JointStates().front();
   CHECK(joint.coordinates[0] == Approx(angle).epsilon(1e-9));
   CHECK(std::abs(joint.coordinates[1]) < 1e-9);
   CHECK(std::abs(joint.coordinates[2]) < 1e-9);
   Vector difference(driven.state);
   difference -= turned.state;
   CHECK(Largest(difference) < 1e-7 * Largest(turned.state));
   const auto a = driven.problem.RigidBodyStates()[1];
   const auto b = turned.problem.RigidBodyStates()[1];
   CHECK(Length(b.moment) > 1e-5);
   CheckSame(a.moment, b.moment, 1e-7 * Length(b.moment));
   // Flexion turns about -x.
   CHECK(joint.drives[0] == Approx(-b.moment[0]).epsilon(1e-6));
   CHECK(driven.iterations <= 40);
   CHECK(driven.newton <= 8);
}

TEST_CASE("Where all coordinates are prescribed the distal body goes along")
{
   const JointOf side = GENERATE(JointOf::right, JointOf::left);
   const LinearMethod method =
      GENERATE(LinearMethod::direct, LinearMethod::block_amg);
   CAPTURE(static_cast<int>(side), static_cast<int>(method));
   Knee knee(Deformation::finite, method);
   RigidBodyOptions femur = Fixed();
   femur.reference = Point3{{0.1, -0.4, 1.9}};
   const Point3 axis{{2.0 / 7.0, -3.0 / 7.0, 6.0 / 7.0}};
   femur.prescribed[1] = Ramp(8.0, 0.6);
   for (int d = 0; d < 3; d++)
   {
      femur.prescribed[d + 3] = Ramp(8.0, 0.5 * M_PI * axis[d]);
   }
   knee.AddBodies(femur, RigidBodyOptions());
   Joint joint = Right("femur", {{0.3, 0.2, 0.7}});
   joint.of = side;
   joint.prescribed.fill(LoadCurve(0.0));
   knee.problem.AddJoint(joint);
   knee.March(8, 1.0);
   const auto states = knee.problem.RigidBodyStates();
   CheckSame(RotationOf(states[1].pose), RotationOf(states[0].pose), 1e-9);
   for (const auto &state : states)
   {
      CHECK(Length(state.force) < 1e-9);
      CHECK(Length(state.moment) < 1e-9);
   }
   for (int k = 0; k < 6; k++)
   {
      const auto now = knee.problem.JointStates().front();
      CHECK(std::abs(now.coordinates[k]) < 1e-9);
      CHECK(std::abs(now.drives[k]) < 1e-9);
   }
}

namespace
{
/// The femur on springs to space, the tibia free, with axes that are skew.
struct Flexed
{
   explicit Flexed(LinearMethod method) : knee(Deformation::finite, method)
   {
      RigidBodyOptions femur;
      femur.stiffness = {{0.3, 0.2, 0.4, 0.1, 0.2, 0.3}};
      knee.AddBodies(femur, RigidBodyOptions());
      joint = Right("femur", {{0.3, 0.2, 0.9}});
      joint.proximal.flexion_axis = {{1.0, 0.2, 0.1}};
      joint.distal.long_axis = {{0.1, -0.1, 1.0}};
      joint.distal.origin = {{0.4, 0.3, 0.5}};
      joint.prescribed[0] = LoadCurve({0.0, 12.0}, {0.0, 1.2});
      knee.problem.AddJoint(joint);
   }
   Knee knee;
   Joint joint;
};
} // namespace

TEST_CASE("What drives flexion alone is a moment about its axis")
{
   const LinearMethod method =
      GENERATE(LinearMethod::direct, LinearMethod::block_amg);
   CAPTURE(static_cast<int>(method));
   Flexed flexed(method);
   Knee &knee = flexed.knee;
   knee.options.active_set_tolerance = 0.0;
   // From where it is skewed as meshed.
   const BonePose rest;
   const real_t meshed =
      JointCoordinates(flexed.joint, rest, rest, Deformation::finite)[0].value;
   CHECK(std::abs(meshed) < 0.2);
   knee.March(6, 2.0);
   const auto joint = knee.problem.JointStates().front();
   CHECK(joint.coordinates[0] == Approx(1.2).epsilon(1e-9));
   const auto states = knee.problem.RigidBodyStates();
   const Point3 right =
      Sum({{0.0, 0.0, 0.0}}, 1.0 / Length(flexed.joint.proximal.flexion_axis),
          Times(RotationMatrix(RotationOf(states[0].pose)),
                flexed.joint.proximal.flexion_axis));
   const Point3 along = Times(RotationMatrix(RotationOf(states[1].pose)),
                              flexed.joint.distal.long_axis);
   const Point3 &moment = states[1].moment;
   CHECK(std::abs(joint.drives[0]) > 1e-3);
   const real_t tolerance = 1e-8 * std::abs(joint.drives[0]);
   CHECK(Length(states[1].force) < tolerance);
   CHECK(Dot(moment, right) == Approx(-joint.drives[0]).epsilon(1e-8));
   CHECK(std::abs(Dot(moment, along)) < 2.0 * tolerance);
   CHECK(std::abs(Dot(moment, Cross(along, right))) < 2.0 * tolerance);
   // The springs of the femur bear nothing else.
   CHECK(Length(states[0].force) < tolerance);
   CHECK(knee.iterations <= 40);
   CHECK(knee.newton <= 8);
}

TEST_CASE("Newton's method with a driven joint converges quadratically")
{
   const auto iterations = [](real_t tolerance)
   {
      Flexed flexed(LinearMethod::direct);
      flexed.knee.options.linear.relative_tolerance = tolerance;
      flexed.knee.options.active_set_tolerance = 0.0;
      flexed.knee.March(6, 2.0);
      return flexed.knee.newton;
   };
   const int coarse = iterations(1e-2);
   const int fine = iterations(1e-12);
   CAPTURE(coarse, fine);
   CHECK(fine <= coarse + 3);
}

TEST_CASE("A resumed run with a driven joint equals the uninterrupted one")
{
   const auto go_on = [](Knee &knee, TimeStepper &stepper, real_t until)
   {
      while (stepper.Time() < until - 1e-9)
      {
         knee.Step(stepper);
      }
   };
   Flexed whole(LinearMethod::direct);
   const TimeOptions times = whole.knee.Times(6, 2.0);
   TimeStepper stepper(whole.knee.problem, times);
   go_on(whole.knee, stepper, times.end);
   const TemporaryDirectory directory;
   {
      Flexed half(LinearMethod::direct);
      half.knee.Times(6, 2.0);
      TimeStepper first(half.knee.problem, times);
      go_on(half.knee, first, 6.0);
      WriteCheckpoint(directory.Path(), half.knee.problem, first);
   }
   Flexed rest(LinearMethod::direct);
   rest.knee.Times(6, 2.0);
   TimeStepper second(rest.knee.problem, times);
   ReadCheckpoint(FindCheckpoint(directory.Path(), MPI_COMM_WORLD).file,
                  rest.knee.problem, second);
   CHECK(rest.knee.problem.JointStates().front().coordinates[0] ==
         Approx(0.6).epsilon(1e-8));
   CHECK(rest.knee.problem.JointStates().front().drives[0] != 0.0);
   go_on(rest.knee, second, times.end);
   Vector difference(second.State());
   difference -= stepper.State();
   CHECK(Largest(difference) <= 1e-9 * Largest(stepper.State()));
   CHECK(
      rest.knee.problem.JointStates().front().drives[0] ==
      Approx(whole.knee.problem.JointStates().front().drives[0]).epsilon(1e-8));
}

TEST_CASE("A coordinate that nothing free changes can't be prescribed")
{
   Knee knee(Deformation::finite, LinearMethod::direct);
   RigidBodyOptions tibia = Fixed();
   SECTION("one of bodies that don't move so")
   {
      tibia.prescribed[2] = std::nullopt;
      knee.AddBodies(Fixed(), tibia);
      Joint joint = Right("femur", {{0.4, 0.3, 0.5}});
      joint.prescribed[0] = 0.1;
      knee.problem.AddJoint(joint);
      CHECK_THROWS_WITH(
         knee.March(1, 1.0),
         Catch::Contains("flexion of the joint \"knee\" can't be "
                         "prescribed"));
   }
   SECTION("one that another joint prescribes")
   {
      knee.AddBodies(Fixed(), RigidBodyOptions());
      Joint joint = Right("femur", {{0.4, 0.3, 0.5}});
      joint.prescribed[0] = 0.1;
      knee.problem.AddJoint(joint);
      joint.name = "same";
      knee.problem.AddJoint(joint);
      CHECK_THROWS_WITH(knee.March(1, 1.0),
                        Catch::Contains("flexion of the joint \"knee\" and "
                                        "flexion of the joint \"same\" can't"));
   }
}

TEST_CASE("What contradicts itself about joints is an error")
{
   Knee knee(Deformation::finite, LinearMethod::direct);
   knee.AddBodies(Fixed(), RigidBodyOptions());
   const auto check = [&](const Joint &wrong, const char *text)
   {
      CHECK_THROWS_WITH(knee.problem.AddJoint(wrong),
                        Catch::Contains("the joint \"knee\": ") &&
                           Catch::Contains(text));
   };
   Joint wrong = Right("femor", {});
   check(wrong, "the proximal side: there is no rigid body \"femor\"");
   wrong = Right("tibia", {});
   check(wrong, "both sides are the rigid body \"tibia\"");
   wrong = Right("", {});
   wrong.distal.body = "";
   check(wrong, "both sides are fixed in space");
   wrong = Right("femur", {});
   wrong.distal.long_axis = {{2.0, 0.0, 0.1}};
   check(wrong, "the distal side: its flexion_axis and long_axis");
   wrong = Right("femur", {});
   wrong.proximal.flexion_axis = {{0.0, 0.0, 0.0}};
   check(wrong, "the proximal side: its flexion_axis and long_axis");
   CHECK_NOTHROW(knee.problem.AddJoint(Right("femur", {})));
}
