// ranks: 1 2 3
//
// A rigid body that its load presses, with the block that is tied to it, onto
// another block: drained and without Poisson's ratio, blocks of heights h_i,
// moduli E_i and the section A give way by F sum h_i / (E_i A), and turn by
// F e sum h_i / (E_i I) if the force acts at e from their axis, which is within
// the core of the section, so that nothing opens. Before they touch, the body
// goes until they do.

#include "support/boxes.hpp"
#include "synovia/fem/rigid_frame.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t long_time = 1e8;

NamedMesh Blocks(real_t gap)
{
   BoxOptions lower;
   lower.nx = lower.ny = 3;
   lower.nz = 2;
   BoxOptions upper(lower);
   upper.nx = upper.ny = 2;
   Mesh mesh = MakeStackMesh(lower, upper);
   for (int i = MakeBoxMesh(lower).GetNV(); i < mesh.GetNV(); i++)
   {
      mesh.GetVertex(i)[2] += gap;
   }
   return DistributeStack(mesh, MPI_COMM_WORLD);
}

struct Press
{
   explicit Press(real_t gap, LinearMethod method)
      : mesh(Blocks(gap)), problem(mesh, SpaceOptions())
   {
      problem.SetMaterial("lower", lower_solid, fluid);
      problem.SetMaterial("upper", upper_solid, fluid);
      problem.FixDisplacement("lower_z0");
      problem.PrescribePressure("upper_z1", 0.0);
      problem.AddContact("upper_z0", "lower_z1");
      NonlinearOptions nonlinear;
      nonlinear.linear.method = method;
      nonlinear.linear.relative_tolerance = 1e-10;
      problem.SetNonlinearOptions(nonlinear);
   }

   StepReport Step()
   {
      TimeOptions times;
      times.step = times.end = long_time;
      times.cut_back = false;
      TimeStepper stepper(problem, times);
      return stepper.Step();
   }

   const IsotropicElastic lower_solid{0.7, 0.0};
   const IsotropicElastic upper_solid{1.4, 0.0};
   const ConstantPermeability fluid{4e-3};
   NamedMesh mesh;
   BiphasicProblem problem;
};

/// Free to sink and to tilt.
RigidBodyOptions Platen(real_t eccentricity, real_t height)
{
   RigidBodyOptions platen;
   platen.reference = Point3{{0.5 + eccentricity, 0.5, height}};
   for (const int fixed : {0, 1, 5})
   {
      platen.prescribed[fixed] = 0.0;
   }
   return platen;
}
} // namespace

TEST_CASE("A loaded body sinks and tilts as far as what it presses gives way")
{
   const real_t gap = GENERATE(0.0, 0.1);
   const LinearMethod method =
      GENERATE(LinearMethod::direct, LinearMethod::block_amg);
   CAPTURE(gap, static_cast<int>(method));
   const real_t force = 0.02;
   const real_t eccentricity = 0.08;
   Press press(gap, method);
   RigidBodyOptions platen = Platen(eccentricity, 2.0 + gap);
   platen.load[2] = -force;
   press.problem.AddRigidBody("platen", {"upper_z1"}, platen);
   const StepReport report = press.Step();
   INFO(report.reason);
   REQUIRE(report.converged);
   const auto &moves = press.problem.Operator().Start().moves;
   REQUIRE(moves.size() == (gap > 0.0 ? 1 : 0));
   if (gap > 0.0)
   {
      CHECK(moves.front().name == "platen");
      CHECK(moves.front().distance == Approx(gap).epsilon(1e-6));
   }
   const auto state = press.problem.RigidBodyStates().front();
   const real_t sinking = force * (1.0 / 0.7 + 1.0 / 1.4);
   const real_t tilt = 12.0 * eccentricity * sinking;
   CHECK(state.pose[4] == Approx(tilt).epsilon(1e-4));
   CHECK(state.pose[2] ==
         Approx(-gap - sinking - tilt * eccentricity).epsilon(1e-4));
   CHECK(std::abs(state.pose[3]) < 1e-6);
   CHECK(state.force[2] == Approx(-force).epsilon(1e-8));
   CHECK(Length(state.moment) < 1e-6 * force);
   const ContactDiagnostics contact =
      Diagnose(*press.problem.Operator().Pairs().front());
   CHECK(contact.destination_force[2] == Approx(-force).epsilon(1e-6));
   CHECK(report.solve.most_linear <= 40);
}

TEST_CASE("A loaded body that meets nothing is an error before the first step")
{
   Press press(0.1, LinearMethod::direct);
   RigidBodyOptions platen = Platen(0.0, 2.1);
   platen.load[2] = 0.01;
   press.problem.AddRigidBody("platen", {"upper_z1"}, platen);
   CHECK_THROWS_WITH(
      press.Step(),
      Catch::Contains("nothing resists the force on \"platen\": along it, (0, "
                      "0, 1), \"upper\" meets no surface"));
}

TEST_CASE("A body with a freedom that contact can't hold is an error")
{
   Press press(0.0, LinearMethod::direct);
   RigidBodyOptions platen = Platen(0.0, 2.0);
   platen.load[2] = -0.01;
   platen.prescribed[0] = std::nullopt;
   press.problem.AddRigidBody("platen", {"upper_z1"}, platen);
   const StepReport report = press.Step();
   CHECK_FALSE(report.converged);
   CHECK_THAT(report.reason,
              Catch::Contains("nothing holds \"upper\", free to move along x"));
}

namespace
{
constexpr int steps = 12;
constexpr real_t step = 10.0;

/// A surface that moves as a rigid body did, from step to step.
class AlongPath : public VectorCoefficient
{
public:
   AlongPath(const RigidPoses &path_, const Point3 &reference_)
      : VectorCoefficient(3), path(path_), reference(reference_)
   {
   }
   void Eval(Vector &u, ElementTransformation &trans,
             const IntegrationPoint &ip) override
   {
      Vector x(3);
      trans.Transform(ip, x);
      const real_t t = GetTime() / step;
      const int before = std::min(static_cast<int>(t + 1e-6), steps - 1);
      const real_t part = t - before;
      RigidPose pose;
      for (int i = 0; i < 6; i++)
      {
         pose[i] = (1.0 - part) * path[before][i] + part * path[before + 1][i];
      }
      const RigidFrame frame(pose, Deformation::finite);
      const Point3 moved =
         frame.Displacement(Sum({{x[0], x[1], x[2]}}, -1.0, reference));
      u.SetSize(3);
      std::copy(moved.begin(), moved.end(), u.begin());
   }

private:
   RigidPoses path;
   Point3 reference;
};

/// What a run took, in all and for its hardest system.
struct Work
{
   int linear = 0;
   int newton = 0;
   int most_linear = 0;
   /// Force and moment of the contact at the end.
   Point3 force{};
   Point3 moment{};
};

/// Blocks in finite deformation, which drain at their sides. The platen is
/// free, and its poses are added to the path; or its surface is moved along a
/// path that isn't empty.
Work PressFinitely(RigidPoses &path)
{
   BoxOptions lower;
   lower.nx = lower.ny = 4;
   lower.nz = 3;
   BoxOptions upper(lower);
   upper.nx = upper.ny = 3;
   upper.size_x = upper.size_y = 0.8;
   Mesh serial = MakeStackMesh(lower, upper);
   NamedMesh mesh = DistributeStack(serial, MPI_COMM_WORLD);
   const NeoHookean lower_solid(0.7, 0.2);
   const NeoHookean upper_solid(1.4, 0.2);
   const ConstantPermeability fluid(4e-3);
   SpaceOptions space;
   space.deformation = Deformation::finite;
   BiphasicProblem problem(mesh, space);
   problem.SetMaterial("lower", lower_solid, fluid);
   problem.SetMaterial("upper", upper_solid, fluid);
   problem.FixDisplacement("lower_z0");
   for (const std::string side : {"_x0", "_x1", "_y0", "_y1"})
   {
      problem.PrescribePressure("lower" + side, 0.0);
      problem.PrescribePressure("upper" + side, 0.0);
   }
   problem.AddContact("upper_z0", "lower_z1");
   NonlinearOptions nonlinear;
   nonlinear.linear.method = LinearMethod::block_amg;
   problem.SetNonlinearOptions(nonlinear);
   const bool free = path.empty();
   RigidBodyOptions platen = Platen(0.0, 2.0);
   platen.reference = Point3{{0.4, 0.4, 2.0}};
   const real_t end = steps * step;
   platen.load[2] = Ramp(end, -0.02);
   platen.load[4] = Ramp(end, 0.0015);
   AlongPath along(path, *platen.reference);
   if (free)
   {
      path.push_back(RigidPose{});
      problem.AddRigidBody("platen", {"upper_z1"}, platen);
   }
   else
   {
      problem.Conditions().PrescribeDisplacement(mesh.Boundary("upper_z1"),
                                                 along);
   }
   TimeOptions times;
   times.step = step;
   times.end = end;
   times.cut_back = false;
   TimeStepper stepper(problem, times);
   Work work;
   while (!stepper.Done())
   {
      const StepReport report = stepper.Step();
      INFO(report.reason);
      REQUIRE(report.converged);
      work.linear += report.solve.linear;
      work.newton += report.solve.newton;
      work.most_linear = std::max(work.most_linear, report.solve.most_linear);
      if (free)
      {
         path.push_back(problem.RigidBodyStates().front().pose);
      }
   }
   const ContactDiagnostics contact =
      Diagnose(*problem.Operator().Pairs().front());
   work.force = contact.destination_force;
   work.moment = contact.destination_moment;
   return work;
}
} // namespace

TEST_CASE("A free platen costs contact no multigrid iterations")
{
   // Beside a run in which its surface is moved along the path that it took.
   RigidPoses path;
   const Work loaded = PressFinitely(path);
   REQUIRE(path.size() == steps + 1);
   CHECK(path.back()[2] < -0.03);
   CHECK(std::abs(path.back()[4]) > 0.02);
   const Work moved = PressFinitely(path);
   CAPTURE(loaded.linear, loaded.newton, loaded.most_linear, moved.linear,
           moved.newton, moved.most_linear);
   // The runs are the same problem.
   CHECK(Length(Sum(loaded.force, -1.0, moved.force)) <=
         1e-4 * Length(moved.force));
   CHECK(Length(Sum(loaded.moment, -1.0, moved.moment)) <=
         1e-3 * Length(moved.moment));
   CHECK(moved.linear >= 250);
   CHECK(loaded.linear <= 1.1 * moved.linear);
   // For a system, too. Which is the hardest one differs.
   CHECK(static_cast<real_t>(loaded.linear) / loaded.newton <=
         1.1 * moved.linear / moved.newton);
}
