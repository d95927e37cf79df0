// ranks: 1 2 3
//
// Two boxes that overlap by a known amount as meshed.

#include "support/boxes.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t overlap = 0.01;
constexpr real_t young = 0.7;

/// Force on the lower box after a step in which nothing is moved.
ContactDiagnostics Press(const ContactOptions &contact)
{
   BoxOptions lower;
   lower.nx = lower.ny = 3;
   lower.nz = 2;
   BoxOptions upper(lower);
   upper.nx = upper.ny = 2;
   Mesh mesh = MakeStackMesh(lower, upper);
   for (int i = MakeBoxMesh(lower).GetNV(); i < mesh.GetNV(); i++)
   {
      mesh.GetVertex(i)[2] -= overlap;
   }
   NamedMesh bodies = DistributeStack(mesh, MPI_COMM_WORLD);
   const IsotropicElastic solid(young, 0.0);
   const ConstantPermeability permeability(4e-3);
   BiphasicProblem problem(bodies, SpaceOptions());
   problem.SetMaterial("lower", solid, permeability);
   problem.SetMaterial("upper", solid, permeability);
   problem.FixDisplacement("lower_z0");
   for (int d = 0; d < 3; d++)
   {
      problem.PrescribeDisplacement("upper_z1", d, 0.0);
   }
   problem.PrescribePressure("upper_z1", 0.0);
   problem.AddContact("upper_z0", "lower_z1", contact);
   TimeOptions times;
   times.step = times.end = 1e8;
   TimeStepper stepper(problem, times);
   const StepReport report = stepper.Step();
   INFO(report.reason);
   REQUIRE(report.converged);
   return Diagnose(*problem.Operator().Pairs().front());
}
} // namespace

TEST_CASE("An initial overlap is pressed out, or measured from")
{
   ContactOptions contact;
   SECTION("pressed out")
   {
      // Two boxes of height 1 share the shortening.
      const real_t force = young * overlap / 2.0;
      const ContactDiagnostics now = Press(contact);
      CHECK(now.destination_force[2] == Approx(-force).epsilon(1e-3));
      CHECK(now.area == Approx(1.0));
   }
   SECTION("measured from")
   {
      contact.initial_overlap = InitialOverlap::remove;
      const ContactDiagnostics now = Press(contact);
      CHECK(std::abs(now.destination_force[2]) < 1e-9);
   }
}

TEST_CASE("An initial overlap beyond the limit is an error")
{
   ContactOptions contact;
   contact.overlap_limit = 0.5 * overlap;
   CHECK_THROWS_WITH(Press(contact),
                     Catch::Contains("the surfaces overlap by up to 0.01") &&
                        Catch::Contains("overlap_limit = 0.005"));
}
