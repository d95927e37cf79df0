// ranks: 1 2 3
//
// A block on springs. Drained, with rollers at two sides, it is a bar of height
// h and cross-section A under the stress -q: its foot, on springs of stiffness
// k altogether, moves by -q A/k, and its top by -q A/k - q h/E.

#include "support/boxes.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <limits>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t young = 0.7;
constexpr real_t stiffness = 2.5;
constexpr real_t load = 0.01;
constexpr real_t width = 2.0;
constexpr real_t depth = 1.5;
constexpr real_t height = 3.0;
constexpr real_t area = width * depth;

struct Motion
{
   real_t foot = 0.0;
   real_t top = 0.0;
   Point3 springs{{0.0, 0.0, 0.0}};
   real_t from_history = 0.0;
   int columns = 0;
};

// The mean over a boundary is that of all its nodes, for the motion is uniform
// there; their spread must be nil.
real_t UniformMotion(BiphasicProblem &problem, const Vector &u,
                     const std::string &boundary)
{
   const NamedMesh &mesh = problem.Mesh();
   Array<int> marker(mesh.Get().bdr_attributes.Max());
   marker = 0;
   marker[mesh.Boundary(boundary)[0] - 1] = 1;
   Array<int> dofs;
   problem.Spaces().Displacement().GetEssentialTrueDofs(marker, dofs, 2);
   real_t range[2] = {-1e9, -1e9};
   for (const int dof : dofs)
   {
      range[0] = std::max(range[0], u[dof]);
      range[1] = std::max(range[1], -u[dof]);
   }
   MPI_Allreduce(MPI_IN_PLACE, range, 2, MPITypeMap<real_t>::mpi_type, MPI_MAX,
                 mesh.GetComm());
   CHECK(range[0] == Approx(-range[1]).epsilon(1e-6));
   return range[0];
}

Motion Solve(const Vector &direction, int parts = 1)
{
   BoxOptions box;
   box.nx = 2;
   box.ny = 2;
   box.nz = 3;
   box.size_x = width;
   box.size_y = depth;
   box.size_z = height;
   NamedMesh mesh = MakeBox(box);
   const IsotropicElastic solid(young, 0.0);
   const ConstantPermeability permeability(1.0);
   BiphasicProblem problem(mesh, SpaceOptions());
   problem.SetMaterial("body", solid, permeability);
   problem.PrescribeDisplacement("x0", 0, 0.0);
   problem.PrescribeDisplacement("y0", 1, 0.0);
   for (int i = 0; i < parts; i++)
   {
      problem.AddSprings({"z0"}, stiffness / parts, direction);
   }
   problem.AddNormalTraction("z1", -load);
   problem.PrescribePressure("z1", 0.0);
   TimeOptions times;
   times.step = times.end = 1e8;
   TimeStepper stepper(problem, times);
   const StepReport report = stepper.Step();
   REQUIRE(report.converged);
   const Vector &u = stepper.State().GetBlock(0);
   Motion motion;
   motion.foot = UniformMotion(problem, u, "z0");
   motion.top = UniformMotion(problem, u, "z1");
   motion.springs = problem.Conditions().Springs()[0].Force(u);
   for (const auto &[name, value] : StepDiagnostics(problem, stepper, report))
   {
      if (name == "spring.z0.z")
      {
         motion.columns++;
         motion.from_history = value;
      }
   }
   return motion;
}

Vector Along(real_t x, real_t y, real_t z)
{
   Vector direction(3);
   direction[0] = x;
   direction[1] = y;
   direction[2] = z;
   return direction;
}
} // namespace

TEST_CASE("A block on springs")
{
   // Without Poisson's ratio the foot keeps its shape, so that springs in all
   // directions do what vertical ones do.
   const bool all = GENERATE(true, false);
   const Motion motion = Solve(all ? Vector() : Along(0.0, 0.0, 3.0));
   const real_t force = load * area;
   CHECK(motion.foot == Approx(-force / stiffness));
   CHECK(motion.top == Approx(-force / stiffness - load * height / young));
   CHECK(motion.springs[0] == Approx(0.0).margin(1e-9));
   CHECK(motion.springs[1] == Approx(0.0).margin(1e-9));
   CHECK(motion.springs[2] == Approx(force));
   CHECK(motion.from_history == Approx(force));
}

TEST_CASE("Only the direction of a vector along springs matters")
{
   const real_t length = GENERATE(1e-200, 1e200);
   const Motion motion = Solve(Along(0.0, 0.0, length));
   CHECK(motion.foot == Approx(-load * area / stiffness));
}

TEST_CASE("Several springs at one surface act together")
{
   const real_t force = load * area;
   const Motion motion = Solve(Along(0.0, 0.0, 1.0), 2);
   CHECK(motion.foot == Approx(-force / stiffness));
   CHECK(motion.from_history == Approx(force));
   CHECK(motion.columns == 1);
}

TEST_CASE("Springs without stiffness or direction are errors")
{
   const real_t nan = std::numeric_limits<real_t>::quiet_NaN();
   const real_t infinity = std::numeric_limits<real_t>::infinity();
   for (const real_t along : {0.0, nan, infinity})
   {
      CHECK_THROWS_WITH(Solve(Along(0.0, along, along > 0.0 ? 1.0 : 0.0)),
                        Catch::Contains("the direction of springs is zero"));
   }
   CHECK_THROWS_WITH(Solve(Along(1.0, nan, 0.0)),
                     Catch::Contains("or not finite"));
   NamedMesh mesh = MakeBox(BoxOptions());
   BiphasicSpaces spaces(mesh.Get(), 2);
   for (const real_t wrong : {0.0, -1.0})
   {
      CHECK_THROWS_WITH(
         SpringFoundation(spaces, mesh.Boundary("z0"), wrong, Vector()),
         Catch::Contains("the stiffness of springs is"));
   }
}
