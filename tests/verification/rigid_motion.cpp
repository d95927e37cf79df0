// ranks: 1 2 3
//
// A rigid motion of small displacements, u = c + omega x r, of all bodies
// together changes no stress, whatever the contact does: the gap sees
// n.(omega x (x_A - x_B)), and x_A - x_B is along n.

#include "support/boxes.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

using namespace mfem;
using namespace synovia;

namespace
{
struct Motion
{
   Point3 shift{{0.0, 0.0, 0.0}};
   Point3 spin{{0.0, 0.0, 0.0}};

   Point3 operator()(const Point3 &x) const
   {
      return Sum(shift, 1.0, Cross(spin, x));
   }
};

struct Fields
{
   Vector pressure;
   Vector traction;
   real_t moved = 0.0;
   real_t area = 0.0;
};

Fields Solve(const Motion &motion)
{
   BoxOptions lower;
   lower.nx = 4;
   lower.ny = 3;
   lower.nz = 2;
   lower.size_z = 0.5;
   lower.type = Element::TETRAHEDRON;
   BoxOptions upper(lower);
   upper.nx = 3;
   upper.ny = 4;
   Mesh mesh = MakeStackMesh(lower, upper);
   // A cylinder on a plane, with contact in a strip and a gap beside it.
   for (int i = MakeBoxMesh(lower).GetNV(); i < mesh.GetNV(); i++)
   {
      real_t *x = mesh.GetVertex(i);
      x[2] += 0.05 * (x[0] - 0.4) * (x[0] - 0.4);
   }
   NamedMesh bodies = DistributeStack(mesh, MPI_COMM_WORLD);
   const IsotropicElastic solid(0.5, 0.2);
   const ConstantPermeability permeability(4e-3);
   BiphasicProblem problem(bodies, SpaceOptions());
   problem.SetMaterial("lower", solid, permeability);
   problem.SetMaterial("upper", solid, permeability);
   const auto field = [&](real_t approach)
   {
      return [&motion, approach](const Vector &x, Vector &u)
      {
         const Point3 rigid = motion({{x[0], x[1], x[2]}});
         for (int d = 0; d < 3; d++)
         {
            u[d] = rigid[d];
         }
         u[2] -= approach;
      };
   };
   VectorFunctionCoefficient below(3, field(0.0));
   VectorFunctionCoefficient above(3, field(0.01));
   problem.Conditions().PrescribeDisplacement(bodies.Boundary("lower_z0"),
                                              below);
   problem.Conditions().PrescribeDisplacement(bodies.Boundary("upper_z1"),
                                              above);
   problem.AddContact("upper_z0", "lower_z1");
   NonlinearOptions nonlinear;
   nonlinear.linear.method = LinearMethod::direct;
   nonlinear.linear.relative_tolerance = 1e-12;
   problem.SetNonlinearOptions(nonlinear);
   TimeOptions times;
   times.step = 5.0;
   times.end = 10.0;
   TimeStepper stepper(problem, times);
   while (!stepper.Done())
   {
      const StepReport report = stepper.Step();
      INFO(report.reason);
      REQUIRE(report.converged);
   }
   const ContactPair &pair = *problem.Operator().Pairs().front();
   const Vector &u = stepper.State().GetBlock(0);
   return {
      stepper.State().GetBlock(1), pair.State().traction,
      MaxOverRanks(u.Size() > 0 ? u.Normlinf() : 0.0, problem.Mesh().GetComm()),
      ContactArea(pair)};
}

real_t LargestDifference(const Vector &a, const Vector &b)
{
   Vector difference(a);
   difference -= b;
   return MaxOverRanks(difference.Size() > 0 ? difference.Normlinf() : 0.0,
                       MPI_COMM_WORLD);
}

real_t Largest(const Vector &a)
{
   return MaxOverRanks(a.Size() > 0 ? a.Normlinf() : 0.0, MPI_COMM_WORLD);
}
} // namespace

TEST_CASE("A rigid motion of a pair in contact changes no stress")
{
   const Fields still = Solve(Motion());
   REQUIRE(Largest(still.traction) > 1e-4);
   REQUIRE(still.area > 0.05);
   REQUIRE(still.area < 0.95);
   Motion motion;
   SECTION("translation")
   {
      motion.shift = {{0.3, -0.2, 0.1}};
   }
   SECTION("rotation")
   {
      motion.spin = {{0.05, -0.1, 0.2}};
   }
   const Fields moved = Solve(motion);
   CHECK(moved.moved > 5.0 * still.moved);
   CHECK(moved.area == Approx(still.area).epsilon(1e-12));
   CHECK(LargestDifference(moved.traction, still.traction) <=
         1e-7 * Largest(still.traction));
   CHECK(LargestDifference(moved.pressure, still.pressure) <=
         1e-7 * Largest(still.pressure));
}
