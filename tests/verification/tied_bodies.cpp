// ranks: 1 2 3
// timeout: 600
//
// What is glued is one body, whatever its meshes:
//
// - bars of different moduli in series lengthen by F/A (h_1/E_1 + h_2/E_2);
// - a block that is twisted, or bent, resists as one that is meshed through;
// - a pair that is compressed by 30 % and turned by 90 degrees keeps its
// stress;
// - all of it on any number of ranks, by both linear solvers.

#include "support/boxes.hpp"
#include "synovia/contact/nodal_resultants.hpp"
#include "synovia/fem/node_positions.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t long_time = 1.0e8;

SpaceOptions Space(int order, Deformation deformation)
{
   SpaceOptions space;
   space.order = order;
   space.deformation = deformation;
   return space;
}

NonlinearOptions Solver(LinearMethod method, real_t tolerance = 1e-10)
{
   NonlinearOptions nonlinear;
   nonlinear.linear.method = method;
   nonlinear.linear.relative_tolerance = tolerance;
   return nonlinear;
}

TimeOptions Steps(int steps)
{
   TimeOptions times;
   times.end = long_time;
   times.step = times.end / steps;
   return times;
}

const TiedInterface &TieOf(BiphasicProblem &problem)
{
   return *problem.Operator().Interfaces().front();
}

BoxOptions BoxOf(std::array<int, 3> cells, real_t height, Element::Type type)
{
   BoxOptions box;
   box.nx = cells[0];
   box.ny = cells[1];
   box.nz = cells[2];
   box.size_z = height;
   box.type = type;
   return box;
}

void CheckSides(const TieDiagnostics &now, real_t size, real_t tolerance)
{
   const real_t force =
      std::max(Length(now.source_force), Length(now.source_moment) / size);
   CHECK(force > 0.0);
   CHECK(Length(Sum(now.source_force, 1.0, now.destination_force)) <=
         1e-10 * force);
   CHECK(Length(Sum(now.source_moment, 1.0, now.destination_moment)) <=
         tolerance * force * size);
}

/// Displacement of the end of two bars under a traction, with nu = 0.
real_t Lengthening(std::array<real_t, 2> young, bool fluid, LinearMethod method)
{
   constexpr real_t traction = 0.01;
   NamedMesh mesh = MakeStack(BoxOf({3, 2, 2}, 0.6, Element::HEXAHEDRON),
                              BoxOf({2, 3, 2}, 0.9, Element::TETRAHEDRON));
   const IsotropicElastic lower(young[0], 0.0);
   const IsotropicElastic upper(young[1], 0.0);
   const ConstantPermeability permeability(1.0);
   BiphasicProblem problem(mesh, Space(2, Deformation::infinitesimal));
   problem.SetMaterial("lower", lower);
   if (fluid)
   {
      problem.SetMaterial("upper", upper, permeability);
      problem.PrescribePressure("upper_z1", 0.0);
   }
   else
   {
      problem.SetMaterial("upper", upper);
   }
   problem.FixDisplacement("lower_z0");
   problem.AddNormalTraction("upper_z1", traction);
   problem.AddTie({"upper_z0"}, {"lower_z1"});
   problem.SetNonlinearOptions(Solver(method));
   TimeStepper stepper(problem, Steps(1));
   const StepReport report = stepper.Step();
   CAPTURE(report.reason);
   REQUIRE(report.converged);
   CHECK(TieOf(problem).Scales().exchanges == false);
   const TieDiagnostics now =
      Diagnose(TieOf(problem), stepper.State().GetBlock(0));
   CHECK(now.destination_force[2] == Approx(traction).epsilon(1e-8));
   CheckSides(now, 1.0, 1e-6);
   real_t top = 0.0;
   const Vector &u = stepper.State().GetBlock(0);
   for (int i = 2; i < u.Size(); i += 3)
   {
      top = std::max(top, u[i]);
   }
   return MaxOverRanks(top, mesh.GetComm()) / traction;
}

/// What moves the top of a block.
using Motion = std::function<void(const Vector &, Vector &)>;

void Twist(const Vector &x, Vector &u)
{
   constexpr real_t angle = 0.02;
   u[0] = -angle * (x[1] - 0.5);
   u[1] = angle * (x[0] - 0.5);
   u[2] = 0.0;
}

void BendOver(const Vector &x, Vector &u)
{
   u[0] = 0.03;
   u[1] = 0.0;
   u[2] = -0.02 * (x[0] - 0.5);
}

struct Resistance
{
   Point3 force{};
   Point3 moment{};
};

/// Force and moment that hold the nodes of a boundary.
Resistance ResistanceOf(BiphasicProblem &problem, const Array<int> &boundary)
{
   Array<int> marker(problem.Mesh().Get().bdr_attributes.Max());
   marker = 0;
   for (const int attribute : boundary)
   {
      marker[attribute - 1] = 1;
   }
   Array<int> dofs;
   problem.Spaces().Displacement().GetEssentialTrueDofs(marker, dofs);
   const Vector positions = NodePositions(problem.Spaces().Displacement());
   Vector here;
   positions.GetSubVector(dofs, here);
   const Vector &forces = problem.Operator().Balance().support;
   MPI_Comm comm = problem.Mesh().GetComm();
   return {SumOfDofs(forces, dofs, comm),
           SumOfMoments(forces, here, dofs, comm)};
}

void Load(BiphasicProblem &problem, NamedMesh &mesh, const std::string &bottom,
          const std::string &top, VectorCoefficient &motion)
{
   problem.FixDisplacement(bottom);
   problem.Conditions().PrescribeDisplacement(mesh.Boundary(top), motion);
   problem.PrescribePressure(top, 0.0);
   problem.SetNonlinearOptions(Solver(LinearMethod::direct));
   TimeStepper stepper(problem, Steps(1));
   const StepReport report = stepper.Step();
   CAPTURE(report.reason);
   REQUIRE(report.converged);
   for (const TiedInterface *tie : problem.Operator().Interfaces())
   {
      CheckSides(Diagnose(*tie, stepper.State().GetBlock(0)), 1.0, 1e-6);
   }
}

Resistance ResistWhole(const Motion &motion)
{
   NamedMesh mesh = MakeBox(BoxOf({6, 6, 10}, 1.5, Element::HEXAHEDRON));
   const IsotropicElastic solid(0.5, 0.3);
   const ConstantPermeability permeability(1.0);
   VectorFunctionCoefficient field(3, motion);
   BiphasicProblem problem(mesh, Space(2, Deformation::infinitesimal));
   problem.SetMaterial("body", solid, permeability);
   Load(problem, mesh, "z0", "z1", field);
   return ResistanceOf(problem, mesh.Boundary("z1"));
}

Resistance ResistTied(const Motion &motion, Element::Type type, int order)
{
   NamedMesh mesh = MakeStack(BoxOf({5, 4, 4}, 0.6, Element::HEXAHEDRON),
                              BoxOf({4, 5, 5}, 0.9, type));
   const IsotropicElastic solid(0.5, 0.3);
   const ConstantPermeability permeability(1.0);
   VectorFunctionCoefficient field(3, motion);
   BiphasicProblem problem(mesh, Space(order, Deformation::infinitesimal));
   problem.SetMaterial("lower", solid, permeability);
   problem.SetMaterial("upper", solid, permeability);
   problem.AddTie({"upper_z0"}, {"lower_z1"});
   Load(problem, mesh, "lower_z0", "upper_z1", field);
   return ResistanceOf(problem, mesh.Boundary("upper_z1"));
}

/// A pair between two rigid plates, of which the upper one comes down by 30 %
/// in three steps and stays there for one, before both are turned together by
/// a right angle.
class TurnedPair
{
public:
   static constexpr real_t height = 1.1;
   static constexpr int steps = 9;

   explicit TurnedPair(LinearMethod method, MPI_Comm comm = MPI_COMM_WORLD)
      : lower_solid(0.5, 0.3), upper_solid(1.0, 0.1), permeability(4e-3),
        serial(MakeStackMesh(BoxOf({2, 2, 2}, 0.6, Element::HEXAHEDRON),
                             BoxOf({3, 3, 2}, 0.5, Element::TETRAHEDRON))),
        mesh(DistributeStack(serial, comm)),
        problem(mesh, Space(2, Deformation::finite))
   {
      problem.SetMaterial("lower", lower_solid, permeability);
      problem.SetMaterial("upper", upper_solid, permeability);
      RigidBodyOptions below;
      below.reference = Point3{{0.0, 0.0, 0.0}};
      RigidBodyOptions above(below);
      for (int d = 0; d < 3; d++)
      {
         below.prescribed[d] = LoadCurve(0.0);
         below.prescribed[3 + d] = LoadCurve(0.0);
      }
      above.prescribed = below.prescribed;
      // Both turn about x through the origin, which carries what has been
      // shifted along z with it.
      std::vector<real_t> times = {0.0, Time(3), Time(4)};
      std::vector<real_t> angles = {0.0, 0.0, 0.0};
      std::vector<real_t> along_y = {0.0, 0.0, 0.0};
      std::vector<real_t> along_z = {0.0, -0.3 * height, -0.3 * height};
      for (int i = 1; i <= steps - 4; i++)
      {
         const real_t angle = 0.5 * M_PI * i / (steps - 4);
         times.push_back(Time(4 + i));
         angles.push_back(angle);
         along_y.push_back(0.3 * height * std::sin(angle));
         along_z.push_back(-0.3 * height * std::cos(angle));
      }
      below.prescribed[3] = LoadCurve(times, angles);
      above.prescribed[3] = LoadCurve(times, angles);
      above.prescribed[1] = LoadCurve(times, along_y);
      above.prescribed[2] = LoadCurve(times, along_z);
      problem.AddRigidBody("below", {"lower_z0"}, below);
      problem.AddRigidBody("above", {"upper_z1"}, above);
      for (const std::string body : {"lower_", "upper_"})
      {
         problem.PrescribePressure(body + "x1", 0.0);
      }
      problem.AddTie({"upper_z0"}, {"lower_z1"});
      problem.SetNonlinearOptions(Solver(method));
      TimeOptions times_of_steps;
      times_of_steps.step = Time(1);
      times_of_steps.end = Time(steps);
      stepper = std::make_unique<TimeStepper>(problem, times_of_steps);
   }

   /// Steps are so long that the fluid is at rest in the end of each.
   static real_t Time(int step) { return 1e6 * step; }

   struct State
   {
      Point3 force;
      Point3 on_tie;
      real_t moment_error;
      int newton;
   };

   std::vector<State> Run()
   {
      std::vector<State> states;
      while (!stepper->Done())
      {
         const StepReport report = stepper->Step();
         CAPTURE(report.reason, report.time);
         REQUIRE(report.converged);
         const TieDiagnostics now =
            Diagnose(TieOf(problem), stepper->State().GetBlock(0));
         states.push_back(
            {problem.RigidBodyStates()[1].force, now.destination_force,
             Length(Sum(now.source_moment, 1.0, now.destination_moment)),
             report.solve.newton});
      }
      return states;
   }

private:
   const NeoHookean lower_solid;
   const NeoHookean upper_solid;
   const ConstantPermeability permeability;
   Mesh serial;
   NamedMesh mesh;
   BiphasicProblem problem;
   std::unique_ptr<TimeStepper> stepper;
};
} // namespace

TEST_CASE("Tied bars lengthen as bars in series do")
{
   const bool fluid = GENERATE(false, true);
   const auto method = GENERATE(LinearMethod::direct, LinearMethod::block_amg);
   const std::array<real_t, 2> young = {2.0, 0.5};
   CHECK(Lengthening(young, fluid, method) ==
         Approx(0.6 / young[0] + 0.9 / young[1]).epsilon(1e-7));
   // However different they are.
   CHECK(Lengthening({500.0, 0.5}, fluid, method) ==
         Approx(0.6 / 500.0 + 0.9 / 0.5).epsilon(1e-7));
}

TEST_CASE("A tied block that is twisted or bent resists as a whole one does")
{
   const auto type = GENERATE(Element::HEXAHEDRON, Element::TETRAHEDRON);
   CAPTURE(static_cast<int>(type));
   const Resistance twisted = ResistWhole(Twist);
   const Resistance twisted_tied = ResistTied(Twist, type, 2);
   CAPTURE(twisted.moment[2], twisted_tied.moment[2]);
   CHECK(twisted_tied.moment[2] == Approx(twisted.moment[2]).epsilon(5e-3));
   const Resistance bent = ResistWhole(BendOver);
   const Resistance bent_tied = ResistTied(BendOver, type, 2);
   CAPTURE(bent.force[0], bent_tied.force[0], bent.moment[1],
           bent_tied.moment[1]);
   CHECK(bent_tied.force[0] == Approx(bent.force[0]).epsilon(5e-3));
   CHECK(bent_tied.moment[1] == Approx(bent.moment[1]).epsilon(5e-3));
}

TEST_CASE("A compressed pair keeps its stress while it turns by 90 degrees")
{
   const auto method = GENERATE(LinearMethod::direct, LinearMethod::block_amg);
   TurnedPair pair(method);
   const std::vector<TurnedPair::State> states = pair.Run();
   REQUIRE(states.size() == TurnedPair::steps);
   const Point3 pressed = states[3].force;
   CHECK(pressed[2] < -0.1);
   for (size_t i = 0; i < states.size(); i++)
   {
      const TurnedPair::State &state = states[i];
      const real_t angle = i < 4 ? 0.0 : 0.5 * M_PI * (i - 3.0) / 5.0;
      CAPTURE(i, state.force[1], state.force[2], state.newton);
      CHECK(state.newton <= 8);
      // The tie bears what the plate does.
      CHECK(Length(Sum(state.force, -1.0, state.on_tie)) <=
            1e-6 * Length(state.force));
      CHECK(state.moment_error <= 1e-5 * Length(state.force));
      if (i >= 4)
      {
         const Point3 turned{
            {pressed[0],
             std::cos(angle) * pressed[1] - std::sin(angle) * pressed[2],
             std::sin(angle) * pressed[1] + std::cos(angle) * pressed[2]}};
         CHECK(Length(Sum(state.force, -1.0, turned)) <=
               1e-6 * Length(pressed));
      }
   }
}

TEST_CASE("Results of ties don't depend on the ranks")
{
   const auto method = GENERATE(LinearMethod::direct, LinearMethod::block_amg);
   const std::vector<TurnedPair::State> together = TurnedPair(method).Run();
   const std::vector<TurnedPair::State> alone =
      TurnedPair(method, MPI_COMM_SELF).Run();
   REQUIRE(together.size() == alone.size());
   for (size_t i = 0; i < alone.size(); i++)
   {
      CAPTURE(i);
      CHECK(Length(Sum(together[i].force, -1.0, alone[i].force)) <=
            1e-6 * Length(alone[i].force));
   }
}

TEST_CASE("Surfaces that share vertices or are rigid can't be tied")
{
   NamedMesh mesh = MakeStack(BoxOf({2, 2, 1}, 0.6, Element::HEXAHEDRON),
                              BoxOf({3, 3, 1}, 0.5, Element::HEXAHEDRON));
   const IsotropicElastic solid(0.5, 0.3);
   const auto error_of = [&](const std::string &source,
                             const std::string &destination, bool rigid,
                             const TieOptions &options)
   {
      BiphasicProblem problem(mesh, Space(1, Deformation::infinitesimal));
      problem.SetMaterial("lower", solid);
      if (rigid)
      {
         problem.AddRigidBody("plate", {}, RigidBodyOptions(), {"upper"});
      }
      else
      {
         problem.SetMaterial("upper", solid);
      }
      problem.FixDisplacement("lower_z0");
      problem.AddTie({source}, {destination}, options, "glue");
      try
      {
         problem.Operator();
      }
      catch (const Error &error)
      {
         return std::string(error.what());
      }
      return std::string();
   };
   using Catch::Matchers::Contains;
   CHECK(error_of("upper_z0", "lower_z1", false, {}).empty());
   CHECK_THAT(error_of("lower_x0", "lower_z1", false, {}),
              Contains("tie \"glue\": source and destination share vertices"));
   CHECK_THAT(error_of("upper_z0", "lower_z1", true, {}),
              Contains("tie \"glue\": its source is a rigid body"));
   CHECK_THAT(error_of("upper_z1", "lower_z0", false, {}),
              Contains("no point of the source is within the search radius"));
   TieOptions negative;
   negative.search_radius = -1.0;
   CHECK_THAT(error_of("upper_z0", "lower_z1", false, negative),
              Contains("search_radius is -1; it must be positive, or 0"));
}
