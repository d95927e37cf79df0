// ranks: 1 2 3
// timeout: 240
//
// The penalties only say how fast the augmentation gets there: forces must not
// depend on them, nor must the multigrid's iterations grow with them or with
// the mesh. A box indents a wider layer, off its symmetry axes.

#include "support/boxes.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t thickness = 0.5;
constexpr int iterations_allowed = 40;

struct Outcome
{
   std::vector<real_t> forces;
   real_t penetration = 0.0;
   // Of the pressure across the contact, over the peak pressure.
   real_t pressure_jump = 0.0;
   int most_linear = 0;
};

Mesh MakeBodies(int level)
{
   BoxOptions layer;
   layer.nx = 5 * level;
   layer.ny = 4 * level;
   layer.nz = 2 * level;
   layer.size_x = 2.0;
   layer.size_y = 2.0;
   layer.size_z = thickness;
   layer.type = Element::TETRAHEDRON;
   BoxOptions box;
   box.nx = 3 * level;
   box.ny = 3 * level;
   box.nz = level;
   box.size_z = 0.4;
   Mesh mesh = MakeStackMesh(layer, box);
   for (int i = MakeBoxMesh(layer).GetNV(); i < mesh.GetNV(); i++)
   {
      mesh.GetVertex(i)[0] += 0.45;
      mesh.GetVertex(i)[1] += 0.55;
   }
   return mesh;
}

Outcome Solve(int order, int level, real_t factor)
{
   Mesh serial = MakeBodies(level);
   NamedMesh mesh = DistributeStack(serial, MPI_COMM_WORLD);
   const IsotropicElastic layer_solid(0.5, 0.1);
   const ConstantPermeability layer_fluid(4.0e-3);
   const IsotropicElastic box_solid(500.0, 0.2);
   const ConstantPermeability box_fluid(4.0);
   SpaceOptions space;
   space.order = order;
   BiphasicProblem problem(mesh, space);
   problem.SetMaterial("lower", layer_solid, layer_fluid);
   problem.SetMaterial("upper", box_solid, box_fluid);
   problem.FixDisplacement("lower_z0");
   problem.PrescribeDisplacement("upper_z1", 0, 0.0);
   problem.PrescribeDisplacement("upper_z1", 1, 0.0);
   problem.PrescribeDisplacement("upper_z1", 2, Ramp(50.0, -0.05));
   problem.PrescribePressure("upper_z1", 0.0);
   ContactOptions contact;
   contact.penalty_factor *= factor;
   problem.AddContact("upper_z0", "lower_z1", contact);
   NonlinearOptions nonlinear;
   nonlinear.linear.method = LinearMethod::block_amg;
   nonlinear.linear.relative_tolerance = 1e-8;
   problem.SetNonlinearOptions(nonlinear);
   TimeOptions times;
   times.end = 100.0;
   times.step = 25.0;
   TimeStepper stepper(problem, times);
   Outcome outcome;
   while (!stepper.Done())
   {
      const StepReport report = stepper.Step();
      CAPTURE(report.reason, report.time);
      REQUIRE(report.converged);
      const ContactDiagnostics found =
         Diagnose(*problem.Operator().Pairs().front());
      const Vector &p = stepper.State().GetBlock(1);
      real_t peak = p.Size() > 0 ? p.Normlinf() : 0.0;
      MPI_Allreduce(MPI_IN_PLACE, &peak, 1, MPITypeMap<real_t>::mpi_type,
                    MPI_MAX, mesh.GetComm());
      outcome.forces.push_back(found.source_force[2]);
      outcome.penetration = std::max(outcome.penetration, found.penetration);
      outcome.pressure_jump =
         std::max(outcome.pressure_jump, found.pressure_jump / peak);
      outcome.most_linear =
         std::max(outcome.most_linear, report.solve.most_linear);
   }
   return outcome;
}
} // namespace

TEST_CASE("Results do not depend on the penalties, nor do iterations")
{
   const int order = GENERATE(1, 2);
   const int level = GENERATE(1, 2);
   const Outcome usual = Solve(order, level, 1.0);
   for (const real_t factor : {1.0, 0.1, 100.0})
   {
      const Outcome found = factor == 1.0 ? usual : Solve(order, level, factor);
      CAPTURE(order, level, factor);
      REQUIRE(found.forces.size() == usual.forces.size());
      for (size_t i = 0; i < usual.forces.size(); i++)
      {
         CAPTURE(i, found.forces[i], usual.forces[i]);
         CHECK(usual.forces[i] > 0.0);
         CHECK(std::abs(found.forces[i] - usual.forces[i]) <=
               1e-3 * usual.forces[i]);
      }
      CHECK(found.penetration <= 1e-4 * thickness);
      CHECK(found.pressure_jump <= 0.01);
      CHECK(found.most_linear <= iterations_allowed);
   }
}
