// ranks: 2
// timeout: 600
//
// Cattaneo (1938) and Mindlin (1949): two elastic bodies with round surfaces
// are pressed together by a force P and then pushed along by Q < mu P. A ring
// around a circle of radius c slides, within it they stick. With Hertz's
// pressure on a circle of radius a, and equal bodies (Johnson, Contact
// Mechanics, 1985, section 7.2),
//
//     c/a = (1 - Q/(mu P))^(1/3),
//     q(r) = mu p_0 [sqrt(1 - r^2/a^2) - c/a sqrt(1 - r^2/c^2)],
//
// the second term for r < c only. So the mean square radii of both tractions
// give c as well: int q r^2 / (mu int p r^2) = 1 - (c/a)^5.
//
// The bodies are boxes, one half of each, far larger than the contact, whose
// outer faces move as a whole; drained.

#include "support/boxes.hpp"
#include "synovia/contact/contact_diagnostics.hpp"
#include "synovia/materials/permeabilities/constant_permeability.hpp"
#include "synovia/materials/solids/neo_hookean.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t size = 5.0;
constexpr real_t radius = 200.0;
constexpr real_t approach = 0.01;
constexpr real_t push = 0.002;
constexpr real_t mu = 0.3;
constexpr int presses = 2;
constexpr int pushes = 4;
constexpr real_t long_time = 1e9;

// Uniform where the contact is, then growing to the size at s = 1.
real_t Graded(real_t s)
{
   constexpr real_t part = 0.6;
   constexpr real_t fine = 1.25;
   constexpr real_t slope = fine / part;
   constexpr real_t rest = 1.0 - part;
   const real_t beyond = std::max(s - part, 0.0);
   return slope * s +
          (size - slope) / (rest * rest * rest) * beyond * beyond * beyond;
}

NamedMesh MakeBodies()
{
   BoxOptions lower;
   lower.nx = 20;
   lower.ny = 10;
   lower.nz = 4;
   BoxOptions upper;
   upper.nx = 17;
   upper.ny = 8;
   upper.nz = 4;
   Mesh mesh = MakeStackMesh(lower, upper);
   mesh.SetCurvature(2);
   GridFunction &nodes = *mesh.GetNodes();
   const FiniteElementSpace &space = *nodes.FESpace();
   Array<int> body(space.GetNDofs());
   Array<int> dofs;
   for (int i = 0; i < mesh.GetNE(); i++)
   {
      space.GetElementDofs(i, dofs);
      for (const int dof : dofs)
      {
         body[dof] = mesh.GetAttribute(i);
      }
   }
   for (int i = 0; i < body.Size(); i++)
   {
      const auto coordinate = [&](int d) -> real_t &
      { return nodes(space.DofToVDof(i, d)); };
      const real_t along = 2.0 * coordinate(0) - 1.0;
      const real_t depth = std::abs(coordinate(2) - 1.0);
      const real_t x = std::copysign(Graded(std::abs(along)), along);
      const real_t y = Graded(coordinate(1));
      const real_t sign = body[i] == 2 ? 1.0 : -1.0;
      const real_t bulge = (x * x + y * y) / (2.0 * radius);
      coordinate(0) = x;
      coordinate(1) = y;
      coordinate(2) = sign * (Graded(depth) + (1.0 - depth) * bulge);
   }
   return DistributeStack(mesh, MPI_COMM_WORLD);
}

struct Partial
{
   /// Q/(mu P).
   real_t share = 0.0;
   /// c/a by the distribution of the tractions.
   real_t stick = 0.0;
   /// The same by the area of the vertices that stick.
   real_t stick_by_area = 0.0;
};

Partial Measure(BiphasicProblem &problem)
{
   const ContactPair &pair = *problem.Operator().Pairs().front();
   const ContactState &state = pair.State();
   const Vector &area = pair.Constraint().Coverage().area;
   FunctionCoefficient squared([](const Vector &x)
                               { return x[0] * x[0] + x[1] * x[1]; });
   ParGridFunction field(&problem.Spaces().Multiplier());
   field.ProjectCoefficient(squared);
   Vector everywhere;
   field.GetTrueDofs(everywhere);
   const Vector r2 =
      pair.Geometry().Destination().Vertices().FromTrueDofs(everywhere);
   real_t sums[2] = {0.0, 0.0};
   for (int j = 0; j < r2.Size(); j++)
   {
      sums[0] -= area[j] * r2[j] * state.traction[j];
      sums[1] += area[j] * r2[j] * state.friction.traction[0][j];
   }
   MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPITypeMap<real_t>::mpi_type, MPI_SUM,
                 problem.Mesh().GetComm());
   const ContactDiagnostics now = Diagnose(pair);
   Partial partial;
   partial.share = now.friction.force[0] / (mu * std::abs(now.source_force[2]));
   partial.stick = std::pow(1.0 - sums[1] / (mu * sums[0]), 0.2);
   partial.stick_by_area = std::sqrt(1.0 - now.friction.sliding);
   return partial;
}
} // namespace

TEST_CASE("The radius within which pushed spheres stick")
{
   NamedMesh mesh = MakeBodies();
   const NeoHookean solid(1.0, 0.3);
   const ConstantPermeability permeability(1.0);
   SpaceOptions space;
   space.deformation = Deformation::finite;
   BiphasicProblem problem(mesh, space);
   const real_t pressed = presses * long_time;
   const real_t end = pressed + pushes * long_time;
   for (const std::string body : {"lower", "upper"})
   {
      problem.SetMaterial(body, solid, permeability);
      const std::string outer = body == "lower" ? "_z0" : "_z1";
      const bool moves = body == "upper";
      for (const std::string face : {"_x0", "_x1", "_y1", outer.c_str()})
      {
         problem.PrescribePressure(body + face, 0.0);
         problem.PrescribeDisplacement(
            body + face, 0,
            LoadCurve({0.0, pressed, end}, {0.0, 0.0, moves ? push : 0.0}));
         problem.PrescribeDisplacement(body + face, 1, 0.0);
         problem.PrescribeDisplacement(body + face, 2,
                                       Ramp(pressed, moves ? -approach : 0.0));
      }
      problem.PrescribeDisplacement(body + "_y0", 1, 0.0);
   }
   ContactOptions contact;
   contact.gap_tolerance = 1e-4 * approach;
   contact.friction = {mu, 1.0};
   problem.AddContact("upper_z0", "lower_z1", contact);
   TimeOptions times;
   times.end = end;
   times.step = long_time;
   TimeStepper stepper(problem, times);
   int compared = 0;
   while (!stepper.Done())
   {
      const StepReport report = stepper.Step();
      CAPTURE(report.last_failure, report.time / long_time,
              report.solve.newton);
      REQUIRE(report.converged);
      CHECK(report.failures == 0);
      CHECK(report.solve.newton <= 9);
      const Partial partial = Measure(problem);
      const real_t exact = std::cbrt(1.0 - partial.share);
      if (partial.share > 0.15 && partial.share < 0.75)
      {
         CAPTURE(partial.share, exact, partial.stick, partial.stick_by_area);
         CHECK(partial.stick == Approx(exact).epsilon(0.012));
         // Vertices are a fifth of a apart.
         CHECK(partial.stick_by_area == Approx(exact).epsilon(0.05));
         compared++;
      }
   }
   CHECK(compared == 4);
}
