// ranks: 1 2 3
// timeout: 300
//
// A confined column under a load on its drained top, right after loading: the
// fluid carries the load, p = load, but for a layer under the top that is much
// thinner than an element. For steps below h^2/(6 H_A kappa) equal orders
// without stabilization don't have this solution: the pressure oscillates
// (Vermeer & Verruijt 1981). The stabilization has to stop that at a hundredth
// of that step, and at any shorter one.

#include "support/march.hpp"
#include "synovia/synovia.hpp"

#include "synovia/general/reduce.hpp"
#include "synovia/linalg/direct_solver.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t load = 0.01;
constexpr int cells = 10;
constexpr int width = 2;
constexpr real_t height = 1.0;

void Confine(BiphasicProblem &problem, const SolidLaw &solid,
             const PermeabilityLaw &permeability)
{
   problem.SetMaterial("body", solid, permeability);
   problem.FixDisplacement("bottom");
   problem.PrescribeDisplacement("x", 0, 0.0);
   problem.PrescribeDisplacement("y", 1, 0.0);
   problem.PrescribePressure("top", 0.0);
   problem.AddNormalTraction("top", -load);
}

/// How a column is meshed.
struct Column
{
   Element::Type type;
   /// Turned on its side, so that prisms lie.
   bool turned;
};

NamedMesh MakeColumn(const Column &column)
{
   const real_t side = width * height / cells;
   if (!column.turned)
   {
      Mesh mesh = Mesh::MakeCartesian3D(width, width, cells, column.type, side,
                                        side, height);
      return DistributeMesh(
         mesh, {{"body", {1}}},
         {{"bottom", {1}}, {"top", {6}}, {"x", {3, 5}}, {"y", {2, 4}}},
         MPI_COMM_WORLD);
   }
   Mesh mesh = Mesh::MakeCartesian3D(cells, width, width, column.type, height,
                                     side, side);
   for (int i = 0; i < mesh.GetNV(); i++)
   {
      real_t *x = mesh.GetVertex(i);
      std::rotate(x, x + 1, x + 3);
   }
   return DistributeMesh(
      mesh, {{"body", {1}}},
      {{"bottom", {5}}, {"top", {3}}, {"x", {2, 4}}, {"y", {1, 6}}},
      MPI_COMM_WORLD);
}

real_t ShortStep(const SolidLaw &solid, const PermeabilityLaw &permeability)
{
   const real_t h = height / cells;
   return h * h /
          (6.0 * solid.AggregateModulus() * permeability.ReferenceValue()) /
          100.0;
}

/// How far the pressure exceeds the load, and how far it rises from a node to
/// the one above, both relative to the load. Exactly, it does neither.
struct Wiggles
{
   real_t overshoot;
   real_t rise;
};

Wiggles Measure(ParMesh &mesh, const Vector &p)
{
   constexpr int levels = cells + 1;
   constexpr int lines = (width + 1) * (width + 1);
   std::vector<real_t> found(levels * lines, -1e300);
   const auto index = [](real_t x)
   { return static_cast<int>(std::lround(x / height * cells)); };
   // Linear pressure: its local dofs are the vertices.
   for (int i = 0; i < mesh.GetNV(); i++)
   {
      const real_t *x = mesh.GetVertex(i);
      const int line = index(x[0]) + (width + 1) * index(x[1]);
      found[lines * index(x[2]) + line] = p[i] / load;
   }
   MPI_Allreduce(MPI_IN_PLACE, found.data(), levels * lines,
                 MPITypeMap<real_t>::mpi_type, MPI_MAX, mesh.GetComm());
   Wiggles wiggles{-1.0, 0.0};
   for (int i = 0; i < levels * lines; i++)
   {
      wiggles.overshoot = std::max(wiggles.overshoot, found[i] - 1.0);
      if (i >= lines)
      {
         wiggles.rise = std::max(wiggles.rise, found[i] - found[i - lines]);
      }
   }
   return wiggles;
}

/// The pressure after one step from rest, of the same equations that
/// BiphasicOperator solves, with or without stabilization.
Vector SolveStep(BiphasicProblem &problem, bool stabilized, real_t dt)
{
   BiphasicSpaces &spaces = problem.Spaces();
   BoundaryConditions &conditions = problem.Conditions();
   VolumeMatrices matrices(spaces, problem.Materials());
   if (!stabilized)
   {
      matrices.stabilization.reset();
   }
   const ContactTerms none;
   BiphasicJacobian jacobian(matrices, spaces.Offsets(),
                             conditions.DisplacementDofs(), none);
   jacobian.SetTimeStep(dt);
   jacobian.SetPressureDofs(conditions.PressureDofs());
   const std::unique_ptr<HypreParMatrix> matrix =
      jacobian.AssembleHeld(jacobian.Holding(1e11), 0.0);
   const std::unique_ptr<Solver> solver =
      MakeDirectSolver(*matrix, MatrixKind::symmetric);

   BlockVector loads(spaces.Offsets());
   BlockVector solution(spaces.Offsets());
   conditions.GetLoads(dt, loads.GetBlock(0), loads.GetBlock(1));
   loads.GetBlock(0).SetSubVector(conditions.DisplacementDofs(), 0.0);
   loads.GetBlock(1) = 0.0;
   solver->Mult(loads, solution);
   ParGridFunction p(&spaces.Pressure());
   p.SetFromTrueDofs(solution.GetBlock(1));
   return p;
}
} // namespace

TEST_CASE("Stabilized linear elements do not oscillate in very short steps")
{
   const Column column = GENERATE(
      Column{Element::HEXAHEDRON, false}, Column{Element::TETRAHEDRON, false},
      Column{Element::TETRAHEDRON, true}, Column{Element::WEDGE, false},
      Column{Element::WEDGE, true});
   const real_t poisson = GENERATE(0.0, 0.0833, 0.4);
   // Shorter still, nothing flows at all.
   const real_t shorter = GENERATE(1.0, 1e-4);
   CAPTURE(static_cast<int>(column.type), column.turned, poisson, shorter);
   const IsotropicElastic solid(0.5417, poisson);
   const ConstantPermeability permeability(4.0e-3);
   const real_t dt = shorter * ShortStep(solid, permeability);
   NamedMesh mesh = MakeColumn(column);
   SpaceOptions space;
   space.order = 1;
   BiphasicProblem problem(mesh, space);
   Confine(problem, solid, permeability);

   March march(problem);
   BackwardEulerSolver backward_euler;
   REQUIRE(march.Step(backward_euler, dt));
   const Wiggles first = Measure(mesh.Get(), march.Pressure());
   CAPTURE(first.overshoot, first.rise);
   CHECK(first.overshoot < 0.01);
   CHECK(first.rise < 0.01);

   // The solver by hand below is the same.
   Vector by_hand = SolveStep(problem, true, dt);
   by_hand -= march.Pressure();
   CHECK(MaxOverRanks(by_hand.Normlinf(), MPI_COMM_WORLD) < 1e-6 * load);

   // It stays so.
   for (int i = 0; i < 5; i++)
   {
      REQUIRE(march.Step(backward_euler, dt));
   }
   const Wiggles later = Measure(mesh.Get(), march.Pressure());
   CAPTURE(later.overshoot, later.rise);
   CHECK(later.overshoot < 0.01);
   CHECK(later.rise < 0.01);

   // Without it the same checks fail by far.
   const Wiggles unstable = Measure(mesh.Get(), SolveStep(problem, false, dt));
   CAPTURE(unstable.overshoot, unstable.rise);
   CHECK(unstable.overshoot > 0.1);
   CHECK(unstable.rise > 0.1);
}
