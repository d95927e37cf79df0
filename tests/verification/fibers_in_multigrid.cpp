// ranks: 1 2 3
// timeout: 240
//
// Multigrid smooths slowly across fibers in a soft matrix: block AMG solves
// exactly for bodies that have them. A box with fibers, oblique to the axes, is
// pressed onto a layer without.

#include "support/boxes.hpp"
#include "support/meniscus_fibers.hpp"
#include "synovia/materials/solids/fiber_pow_linear.hpp"
#include "synovia/materials/solids/holmes_mow.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>

using namespace mfem;
using namespace synovia;

namespace
{
struct Outcome
{
   std::vector<real_t> forces;
   int linear = 0;
   int newton = 0;
   int factorizations = 0;
};

/// Solids of the layer and of the box, which lives as long.
struct Solids
{
   const SolidLaw &layer;
   const SolidLaw &box;
   Deformation deformation;
};

using Drive = std::function<void(BiphasicProblem &)>;

void MoveTop(BiphasicProblem &problem)
{
   problem.PrescribeDisplacement("upper_z1", 0, 0.0);
   problem.PrescribeDisplacement("upper_z1", 1, 0.0);
   problem.PrescribeDisplacement("upper_z1", 2, Ramp(40.0, -0.08));
}

// On a platen that is held sideways by springs, and may tilt.
void LoadTop(BiphasicProblem &problem)
{
   RigidBodyOptions platen;
   platen.reference = Point3{{1.1, 0.9, 1.0}};
   platen.prescribed[5] = 0.0;
   platen.load[2] = Ramp(40.0, -0.3);
   platen.stiffness[0] = platen.stiffness[1] = 10.0;
   problem.AddRigidBody("platen", {"upper_z1"}, platen);
}

Outcome Press(const Solids &solids, const NonlinearOptions &nonlinear,
              const Drive &drive = MoveTop)
{
   BoxOptions layer;
   layer.nx = 6;
   layer.ny = 6;
   layer.nz = 3;
   layer.size_x = 2.0;
   layer.size_y = 2.0;
   layer.size_z = 0.5;
   BoxOptions box(layer);
   box.nx = 5;
   box.ny = 5;
   NamedMesh mesh = MakeStack(layer, box);
   const ConstantPermeability permeability(3.0e-3);
   SpaceOptions space;
   space.order = 1;
   space.deformation = solids.deformation;
   BiphasicProblem problem(mesh, space);
   problem.SetMaterial("lower", solids.layer, permeability);
   problem.SetMaterial("upper", solids.box, permeability);
   problem.FixDisplacement("lower_z0");
   drive(problem);
   problem.PrescribePressure("upper_x1", 0.0);
   problem.AddContact("upper_z0", "lower_z1");
   problem.SetNonlinearOptions(nonlinear);
   TimeOptions times;
   times.end = 40.0;
   times.step = 10.0;
   TimeStepper stepper(problem, times);
   Outcome outcome;
   while (!stepper.Done())
   {
      const StepReport report = stepper.Step();
      CAPTURE(report.reason, report.time);
      REQUIRE(report.converged);
      outcome.forces.push_back(
         Diagnose(*problem.Operator().Pairs().front()).source_force[2]);
      outcome.linear += report.solve.linear;
      outcome.newton += report.solve.newton;
   }
   outcome.factorizations = problem.Operator().Work().factorizations;
   return outcome;
}

// Of a system there are at most so many iterations, each with one exact solve
// for displacements.
void CheckFibers(const Solids &solids, int most_iterations)
{
   NonlinearOptions nonlinear;
   nonlinear.linear.method = LinearMethod::direct;
   const Outcome expected = Press(solids, nonlinear);
   nonlinear.linear.method = LinearMethod::block_amg;
   // Iterations shall be those of the present tangent.
   nonlinear.tuning.multigrid.rebuild_cost = 0.0;
   const Outcome found = Press(solids, nonlinear);
   nonlinear.tuning.multigrid.smooth_anisotropy = 1e9;
   const Outcome smoothed = Press(solids, nonlinear);
   CAPTURE(found.linear, found.newton, smoothed.linear, smoothed.newton);
   REQUIRE(found.forces.size() == expected.forces.size());
   for (std::size_t i = 0; i < found.forces.size(); i++)
   {
      CAPTURE(i, expected.forces[i]);
      CHECK(expected.forces[i] > 0.0);
      CHECK(found.forces[i] == Approx(expected.forces[i]).epsilon(1e-4));
   }
   CHECK(found.linear <= most_iterations * found.newton);
   CHECK(2 * found.linear <= smoothed.linear);
}
} // namespace

/// A mixture of which the fibers are slack as meshed, on a layer without.
struct SlackFibers
{
   const CartesianFrame frame{{1.0, 2.0, 0.0}};
   const HolmesMow layer{0.69, 0.018, 0.35};
   const HolmesMow matrix{0.075, 0.3, 0.35};
   const FiberPowLinear fibers{100.0, 1.01, 3.0, FiberDirection(frame)};
   const SolidMixture box{{&matrix, &fibers}};
   const Solids solids{layer, box, Deformation::finite};
};

TEST_CASE("Fibers cost multigrid no iterations")
{
   const CartesianFrame frame({1.0, 2.0, 0.0});
   const IsotropicElastic layer(0.69, 0.018);
   const TransverselyIsotropic box(MeniscusFibers(), frame);
   CheckFibers({layer, box, Deformation::infinitesimal}, 10);
}

TEST_CASE("Fibers that are slack as meshed cost multigrid no iterations")
{
   const SlackFibers fibers;
   CheckFibers(fibers.solids, 12);
}

TEST_CASE("A force on a rigid body above fibers costs multigrid few iterations")
{
   const SlackFibers fibers;
   NonlinearOptions nonlinear;
   nonlinear.linear.method = LinearMethod::direct;
   const Outcome expected = Press(fibers.solids, nonlinear, LoadTop);
   nonlinear.linear.method = LinearMethod::block_amg;
   const Outcome found = Press(fibers.solids, nonlinear, LoadTop);
   CAPTURE(found.linear, found.newton, expected.linear, expected.newton);
   REQUIRE(found.forces.size() == expected.forces.size());
   for (std::size_t i = 0; i < found.forces.size(); i++)
   {
      CHECK(found.forces[i] == Approx(expected.forces[i]).epsilon(1e-4));
      CHECK(found.forces[i] > 0.0);
   }
   CHECK(found.linear <= 12 * found.newton);
   CHECK(found.linear <= 1.2 * expected.linear);
}

TEST_CASE("Exact solves for fibers serve on while the tangent is kept")
{
   const SlackFibers fibers;
   NonlinearOptions nonlinear;
   nonlinear.linear.method = LinearMethod::block_amg;
   const Outcome kept = Press(fibers.solids, nonlinear);
   nonlinear.tuning.newton.kept_tangent = 0.0;
   const Outcome renewed = Press(fibers.solids, nonlinear);
   CAPTURE(kept.linear, kept.newton, renewed.linear, renewed.newton);
   CAPTURE(kept.factorizations, renewed.factorizations);
   CHECK(kept.factorizations < renewed.factorizations);
   CHECK(kept.linear <= 1.2 * renewed.linear);
   for (std::size_t i = 0; i < kept.forces.size(); i++)
   {
      CHECK(kept.forces[i] == Approx(renewed.forces[i]).epsilon(1e-6));
   }
}

TEST_CASE("Bodies with fibers and no contact are solved for exactly, too")
{
   BoxOptions box;
   box.nx = box.ny = box.nz = 3;
   box.size_z = 0.5;
   const CartesianFrame frame({1.0, 2.0, 0.0});
   const TransverselyIsotropic solid(MeniscusFibers(), frame);
   const ConstantPermeability permeability(3.0e-3);
   std::vector<Vector> solutions;
   for (const LinearMethod method :
        {LinearMethod::direct, LinearMethod::block_amg})
   {
      NamedMesh mesh = MakeBox(box);
      SpaceOptions space;
      space.order = 1;
      BiphasicProblem problem(mesh, space);
      problem.SetMaterial("body", solid, permeability);
      problem.FixDisplacement("z0");
      problem.PrescribeDisplacement("z1", 2, -0.05);
      problem.PrescribePressure("x1", 0.0);
      NonlinearOptions nonlinear;
      nonlinear.linear.method = method;
      problem.SetNonlinearOptions(nonlinear);
      TimeOptions times;
      times.end = 10.0;
      times.step = 5.0;
      TimeStepper stepper(problem, times);
      while (!stepper.Done())
      {
         const StepReport report = stepper.Step();
         REQUIRE(report.converged);
         CHECK(report.solve.linear <= 20 * report.solve.newton);
      }
      solutions.emplace_back(stepper.State().GetBlock(0));
   }
   MPI_Comm comm = MPI_COMM_WORLD;
   const real_t size =
      std::sqrt(InnerProduct(comm, solutions[0], solutions[0]));
   solutions[1] -= solutions[0];
   CHECK(size > 0.0);
   CHECK(std::sqrt(InnerProduct(comm, solutions[1], solutions[1])) <=
         1e-6 * size);
}

TEST_CASE("Fibers that single precision doesn't resolve get double")
{
   const CartesianFrame frame({1.0, 2.0, 0.0});
   const IsotropicElastic layer(0.69, 0.018);
   FiberConstants rigid = MeniscusFibers();
   rigid.young_theta = 1e7;
   rigid.poisson_rtheta = 0.0;
   const TransverselyIsotropic box(rigid, frame);
   NonlinearOptions nonlinear;
   nonlinear.linear.method = LinearMethod::block_amg;
   const Outcome found =
      Press({layer, box, Deformation::infinitesimal}, nonlinear);
   nonlinear.tuning.factorization.single_precision = false;
   const Outcome expected =
      Press({layer, box, Deformation::infinitesimal}, nonlinear);
   for (std::size_t i = 0; i < found.forces.size(); i++)
   {
      CHECK(found.forces[i] == Approx(expected.forces[i]).epsilon(1e-6));
   }
   CHECK(found.newton == expected.newton);
   CHECK(found.linear <= 10 * found.newton);
}
