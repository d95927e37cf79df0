// ranks: 1 2 3
//
// Surfaces that a force moves rigidly.
//
// Drained, without Poisson's ratio and with a lower half of modulus E1 under
// an upper one of E2, a column under the force F shortens by
// F/A (h1/E1 + h2/E2), whatever its sections do. Anything else that a force
// moves by q must need that force when it is moved by q.

#include "support/boxes.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t long_time = 1e8;

struct Driven
{
   real_t travel = 0.0;
   Point3 reaction{{0.0, 0.0, 0.0}};
   Point3 contact{{0.0, 0.0, 0.0}};
   bool converged = false;
   std::string reason;
   /// Largest difference of the driven components from direction x travel.
   real_t warp = 0.0;
   int iterations = 0;
};

Vector Along(real_t x, real_t y, real_t z)
{
   return Vector({x, y, z});
}

real_t Value(const History::Row &row, const std::string &column)
{
   for (const auto &[name, value] : row)
   {
      if (name == column)
      {
         return value;
      }
   }
   FAIL("the history has no column " << column);
   return 0.0;
}

real_t Warp(BiphasicProblem &problem, const Vector &u,
            const std::string &boundary, const Vector &direction, real_t travel)
{
   Array<int> marker(problem.Mesh().Get().bdr_attributes.Max());
   marker = 0;
   marker[problem.Mesh().Boundary(boundary)[0] - 1] = 1;
   real_t worst = 0.0;
   for (int d = 0; d < 3; d++)
   {
      if (direction[d] != 0.0)
      {
         Array<int> dofs;
         problem.Spaces().Displacement().GetEssentialTrueDofs(marker, dofs, d);
         for (const int dof : dofs)
         {
            worst = std::max(worst, std::abs(u[dof] - direction[d] * travel));
         }
      }
   }
   return MaxOverRanks(worst, problem.Mesh().GetComm());
}

/// Two boxes, the upper one smaller and twice as stiff; its top is moved along
/// a unit direction by a force, or by a displacement if that is not zero.
struct Press
{
   Vector direction = Along(0.0, 0.0, -1.0);
   real_t force = 0.0;
   real_t displacement = 0.0;
   real_t young_upper = 1.4;
   real_t poisson = 0.0;
   real_t gap = 0.0;
   bool same_width = true;
   LinearMethod method = LinearMethod::direct;
   real_t step = long_time;
   int steps = 1;
};

Driven Solve(const Press &press)
{
   BoxOptions lower;
   lower.nx = 3;
   lower.ny = 3;
   lower.nz = 2;
   lower.type = Element::TETRAHEDRON;
   BoxOptions upper(lower);
   upper.nx = upper.ny = 2;
   if (!press.same_width)
   {
      upper.size_x = upper.size_y = 0.6;
   }
   Mesh mesh = MakeStackMesh(lower, upper);
   for (int i = MakeBoxMesh(lower).GetNV(); i < mesh.GetNV(); i++)
   {
      mesh.GetVertex(i)[2] += press.gap;
   }
   NamedMesh bodies = DistributeStack(mesh, MPI_COMM_WORLD);
   const IsotropicElastic solid(0.7, press.poisson);
   const IsotropicElastic upper_solid(press.young_upper, press.poisson);
   const ConstantPermeability permeability(4e-3);
   BiphasicProblem problem(bodies, SpaceOptions());
   problem.SetMaterial("lower", solid, permeability);
   problem.SetMaterial("upper", upper_solid, permeability);
   problem.FixDisplacement("lower_z0");
   problem.PrescribePressure("upper_z1", 0.0);
   const std::string top = "upper_z1";
   for (int d = 0; d < 3; d++)
   {
      if (press.direction[d] == 0.0)
      {
         problem.PrescribeDisplacement(top, d, 0.0);
      }
      else if (press.displacement != 0.0)
      {
         problem.PrescribeDisplacement(top, d,
                                       press.direction[d] * press.displacement);
      }
   }
   if (press.displacement == 0.0)
   {
      Vector longer(press.direction);
      longer *= 3.0;
      problem.DriveByForce({top}, longer, press.force);
   }
   problem.AddContact("upper_z0", "lower_z1");
   NonlinearOptions nonlinear;
   nonlinear.linear.method = press.method;
   nonlinear.linear.relative_tolerance = 1e-10;
   problem.SetNonlinearOptions(nonlinear);
   TimeOptions times;
   times.step = press.step;
   times.end = press.steps * press.step;
   times.cut_back = false;
   TimeStepper stepper(problem, times);
   Driven driven;
   for (int i = 0; i < press.steps; i++)
   {
      const StepReport report = stepper.Step();
      driven.converged = report.converged;
      driven.reason = report.reason;
      if (!report.converged)
      {
         return driven;
      }
      driven.iterations = std::max(driven.iterations, report.solve.most_linear);
      const History::Row row = StepDiagnostics(problem, stepper, report);
      driven.travel = press.displacement != 0.0 ? press.displacement
                                                : Value(row, "travel." + top);
      const char *axes[3] = {"x", "y", "z"};
      for (int d = 0; d < 3; d++)
      {
         driven.reaction[d] = Value(row, "reaction." + top + "." + axes[d]);
         driven.contact[d] = Value(row, "contact.upper_z0-lower_z1.force_" +
                                           std::string(axes[d]));
      }
      driven.warp = Warp(problem, stepper.State().GetBlock(0), top,
                         press.direction, driven.travel);
   }
   return driven;
}
} // namespace

TEST_CASE("A force shortens a column by F/A (h1/E1 + h2/E2)")
{
   Press press;
   press.force = 0.02;
   press.method = GENERATE(LinearMethod::direct, LinearMethod::block_amg);
   const Driven driven = Solve(press);
   REQUIRE(driven.converged);
   CHECK(driven.travel == Approx(0.02 * (1.0 / 0.7 + 1.0 / 1.4)).epsilon(1e-5));
   CHECK(driven.reaction[2] == Approx(-0.02).epsilon(1e-6));
   CHECK(driven.contact[2] == Approx(-0.02).epsilon(1e-6));
   CHECK(driven.warp <= 1e-12);
   CHECK(driven.iterations <= 40);
}

TEST_CASE("A force moves a surface as far as needs that force")
{
   Press press;
   press.poisson = 0.3;
   press.same_width = false;
   press.young_upper = 20.0;
   press.step = 10.0;
   press.steps = 2;
   const bool oblique = GENERATE(false, true);
   press.direction = oblique ? Along(0.0, -0.28, -0.96) : Along(0.0, 0.0, -1.0);
   press.displacement = 0.01;
   const Driven moved = Solve(press);
   REQUIRE(moved.converged);

   Press pushed(press);
   pushed.displacement = 0.0;
   for (int d = 0; d < 3; d++)
   {
      pushed.force += moved.reaction[d] * press.direction[d];
   }
   REQUIRE(pushed.force > 1e-3);
   SECTION("in the end")
   {
      // A constant displacement and a constant force agree in the long run.
      press.step = pushed.step = long_time;
      press.steps = pushed.steps = 1;
      const Driven rest = Solve(press);
      REQUIRE(rest.converged);
      pushed.force = 0.0;
      for (int d = 0; d < 3; d++)
      {
         pushed.force += rest.reaction[d] * press.direction[d];
      }
      const Driven driven = Solve(pushed);
      REQUIRE(driven.converged);
      CHECK(driven.travel == Approx(0.01).epsilon(1e-6));
      CHECK(driven.warp <= 1e-10);
      for (int d = 0; d < 3; d++)
      {
         CHECK(driven.contact[d] ==
               Approx(rest.contact[d]).margin(1e-7 * pushed.force));
      }
   }
   SECTION("step by step with either solver")
   {
      const Driven driven = Solve(pushed);
      pushed.method = LinearMethod::block_amg;
      const Driven iterated = Solve(pushed);
      REQUIRE(driven.converged);
      REQUIRE(iterated.converged);
      CHECK(driven.travel == Approx(iterated.travel).epsilon(1e-6));
      CHECK(driven.warp <= 1e-10);
      CHECK(iterated.iterations <= 40);
   }
}

TEST_CASE("A force that meets nothing is an error before the first step")
{
   Press press;
   press.force = -0.02;
   press.gap = 0.3;
   CHECK_THROWS_WITH(
      Solve(press),
      Catch::Contains("nothing resists the force on \"upper_z1\": along it, "
                      "(0, 0, 1), \"upper\" meets no surface"));
}

TEST_CASE("A surface can't be driven twice")
{
   NamedMesh mesh = MakeBox(BoxOptions());
   BiphasicSpaces spaces(mesh.Get(), 2);
   const std::vector<DrivenSurface> top = {
      {"z1", mesh.Boundary("z1"), {{0.0, 0.0, 1.0}}, 1.0}};
   CHECK(RigidSurfaces(spaces, top, Array<int>()).Any());
   std::vector<DrivenSurface> both(top);
   both.push_back({"x1", mesh.Boundary("x1"), {{0.6, 0.0, 0.8}}, 1.0});
   CHECK_THROWS_WITH(RigidSurfaces(spaces, both, Array<int>()),
                     Catch::Contains("\"x1\"") &&
                        Catch::Contains("another force moves"));
   BoundaryConditions conditions(spaces);
   conditions.PrescribeDisplacement(mesh.Boundary("x1"), 2, 0.0);
   CHECK_THROWS_WITH(RigidSurfaces(spaces, top, conditions.DisplacementDofs()),
                     Catch::Contains("\"z1\"") &&
                        Catch::Contains("leave that displacement"));
   CHECK_THROWS_WITH(
      conditions.DriveByForce(mesh.Boundary("z1"), Along(0.0, 0.0, 0.0), 1.0),
      Catch::Contains("direction of a force is zero"));
}
