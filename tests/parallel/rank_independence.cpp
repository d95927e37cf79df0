// ranks: 1 2 3 4
// timeout: 120
//
// A problem solved by all ranks together gives what each rank finds alone: a
// box pressed eccentrically onto a wider layer, so that contact comes and goes.

#include "support/boxes.hpp"
#include "synovia.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t agreement = 1e-6;

struct Setup
{
   int order = 1;
   LinearMethod method = LinearMethod::direct;
};

struct Row
{
   Point3 reaction;
   Point3 source_force;
   real_t peak_pressure = 0.0;
   real_t peak_traction = 0.0;
   real_t area = 0.0;
   real_t outflow = 0.0;
   int newton = 0;
};

Mesh MakeBodies()
{
   BoxOptions layer;
   layer.nx = 5;
   layer.ny = 4;
   layer.nz = 2;
   layer.size_x = 2.0;
   layer.size_y = 2.0;
   layer.size_z = 0.5;
   layer.type = Element::TETRAHEDRON;
   BoxOptions box;
   box.nx = 3;
   box.ny = 3;
   box.nz = 1;
   box.size_z = 0.4;
   Mesh mesh = MakeStackMesh(layer, box);
   // Away from the layer's sides, and rounded underneath: contact starts at an
   // edge and grows.
   for (int i = MakeBoxMesh(layer).GetNV(); i < mesh.GetNV(); i++)
   {
      real_t *x = mesh.GetVertex(i);
      x[0] += 0.45;
      x[1] += 0.55;
      if (x[2] < 0.7)
      {
         x[2] += 0.02 * (x[0] - 0.45) * (x[0] - 0.45);
      }
   }
   return mesh;
}

std::vector<Row> Solve(const Setup &setup, MPI_Comm comm)
{
   Mesh serial = MakeBodies();
   NamedMesh mesh = DistributeStack(serial, comm);
   const IsotropicElastic layer_solid(0.5, 0.1);
   const ConstantPermeability layer_fluid(4.0e-3);
   const IsotropicElastic box_solid(5.0, 0.2);
   const ConstantPermeability box_fluid(4.0e-2);
   SpaceOptions space;
   space.order = setup.order;
   BiphasicProblem problem(mesh, space);
   problem.SetMaterial("lower", layer_solid, layer_fluid);
   problem.SetMaterial("upper", box_solid, box_fluid);
   problem.FixDisplacement("lower_z0");
   problem.PrescribeDisplacement("upper_z1", 0, 0.0);
   problem.PrescribeDisplacement("upper_z1", 1, 0.0);
   // Down, and up again as far as to where it lifts off in part.
   problem.PrescribeDisplacement(
      "upper_z1", 2, LoadCurve({0.0, 40.0, 80.0}, {0.0, -0.03, -0.01}));
   problem.PrescribePressure("upper_z1", 0.0);
   problem.AddContact("upper_z0", "lower_z1");
   NonlinearOptions nonlinear;
   nonlinear.linear.method = setup.method;
   nonlinear.linear.relative_tolerance = 1e-11;
   problem.SetNonlinearOptions(nonlinear);
   TimeOptions times;
   times.end = 80.0;
   times.step = 10.0;
   TimeStepper stepper(problem, times);
   std::vector<Row> rows;
   while (!stepper.Done())
   {
      const StepReport report = stepper.Step();
      CAPTURE(report.reason, report.time);
      REQUIRE(report.converged);
      Row row;
      row.reaction = problem.Reaction(problem.Supports().back());
      const ContactPair::Diagnostics contact =
         problem.Operator().Pairs().front()->Diagnose();
      row.source_force = contact.source_force;
      row.peak_traction = contact.peak_traction;
      row.area = contact.area;
      const Vector &p = stepper.State().GetBlock(1);
      row.peak_pressure = p.Size() > 0 ? p.Normlinf() : 0.0;
      MPI_Allreduce(MPI_IN_PLACE, &row.peak_pressure, 1,
                    MPITypeMap<real_t>::mpi_type, MPI_MAX, comm);
      row.outflow = problem.Operator().Fluid().outflow;
      row.newton = report.solve.newton;
      rows.push_back(row);
   }
   return rows;
}
} // namespace

TEST_CASE("All ranks together find what each finds alone")
{
   Setup setup;
   setup.order = GENERATE(1, 2);
   setup.method = GENERATE(LinearMethod::direct, LinearMethod::block_amg);
   CAPTURE(setup.order, static_cast<int>(setup.method));
   const std::vector<Row> together = Solve(setup, MPI_COMM_WORLD);
   const std::vector<Row> alone = Solve(setup, MPI_COMM_SELF);
   REQUIRE(together.size() == alone.size());
   real_t largest_force = 0.0;
   real_t largest_pressure = 0.0;
   real_t largest_outflow = 0.0;
   real_t least_area = 1.0;
   real_t largest_area = 0.0;
   for (const Row &row : alone)
   {
      largest_force = std::max(largest_force, std::abs(row.reaction[2]));
      largest_pressure = std::max(largest_pressure, row.peak_pressure);
      largest_outflow = std::max(largest_outflow, std::abs(row.outflow));
      least_area = std::min(least_area, row.area);
      largest_area = std::max(largest_area, row.area);
   }
   // There is something to compare.
   CHECK(largest_force > 1e-3);
   CHECK(largest_pressure > 1e-3);
   CHECK(least_area < 0.7 * largest_area);
   for (size_t i = 0; i < alone.size(); i++)
   {
      CAPTURE(i, together[i].newton, alone[i].newton);
      for (int d = 0; d < 3; d++)
      {
         CHECK(std::abs(together[i].reaction[d] - alone[i].reaction[d]) <=
               agreement * std::abs(alone[i].reaction[2]));
         CHECK(
            std::abs(together[i].source_force[d] - alone[i].source_force[d]) <=
            agreement * std::abs(alone[i].source_force[2]));
      }
      CHECK(together[i].peak_pressure ==
            Approx(alone[i].peak_pressure).epsilon(agreement));
      CHECK(together[i].peak_traction ==
            Approx(alone[i].peak_traction).epsilon(agreement));
      CHECK(together[i].area == Approx(alone[i].area).epsilon(agreement));
      CHECK(std::abs(together[i].outflow - alone[i].outflow) <=
            agreement * largest_outflow);
   }
}
