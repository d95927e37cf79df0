// ranks: 2
// timeout: 600
//
// Hertz's contact of two elastic bodies with paraboloid surfaces, the drained
// limit of biphasic ones. With the radii R_1 and R_2, 1/R = 1/R_1 + 1/R_2,
// equal moduli, 1/E* = 2 (1 - nu^2)/E, and an approach delta of points far
// away,
//
//     a = sqrt(R delta),  F = 4/3 E* a^3 / R,  p(r) = p_0 sqrt(1 - r^2/a^2),
//     p_0 = 3 F / (2 pi a^2).
//
// The second moment of p gives a: int p r^2 / int p = 2/5 a^2.
//
// The bodies are boxes of ten contact radii, a quarter of each. Their outer
// faces move as Boussinesq's half-space does there under the point force F
// (Johnson, Contact Mechanics, 1985, section 3.2), with depth z and
// rho^2 = r^2 + z^2,
//
//     u_r = F/(4 pi mu) [r z/rho^3 - (1 - 2 nu) r/(rho (rho + z))],
//     u_z = F/(4 pi mu) [z^2/rho^3 + 2 (1 - nu)/rho],
//
// the upper ones by -delta more. So boxes of finite size act as half-spaces do,
// up to (a/L)^2 of a displacement that is small itself.

#include "support/boxes.hpp"
#include "support/traction_moments.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
const real_t pi = 4.0 * std::atan(1.0);
constexpr real_t young = 1.0;
constexpr real_t poisson = 0.3;
constexpr real_t a = 1.0;
constexpr real_t size = 10.0;
constexpr real_t lower_radius = 300.0;
constexpr real_t upper_radius = 150.0;

struct Hertz
{
   real_t radius = 1.0 / (1.0 / lower_radius + 1.0 / upper_radius);
   real_t modulus = 0.5 * young / (1.0 - poisson * poisson);
   real_t approach = a * a / radius;
   real_t force = 4.0 / 3.0 * modulus * a * a * a / radius;
   real_t peak = 1.5 * force / (pi * a * a);
};

// Uniform where the contact is, then growing to the size at s = 1.
real_t Graded(real_t s)
{
   constexpr real_t part = 0.55;
   constexpr real_t fine = 1.3;
   constexpr real_t slope = fine / part;
   constexpr real_t rest = 1.0 - part;
   const real_t beyond = std::max(s - part, 0.0);
   return slope * s +
          (size - slope) / (rest * rest * rest) * beyond * beyond * beyond;
}

NamedMesh MakeBodies(int lower_cells, int upper_cells)
{
   BoxOptions lower;
   lower.nx = lower.ny = lower.nz = lower_cells;
   BoxOptions upper = lower;
   upper.nx = upper.ny = upper.nz = upper_cells;
   Mesh mesh = MakeStackMesh(lower, upper);
   // The bodies share the plane z = 1, so each must be told by its elements.
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
      const real_t depth = std::abs(coordinate(2) - 1.0);
      const real_t x = Graded(coordinate(0));
      const real_t y = Graded(coordinate(1));
      const bool is_upper = body[i] == 2;
      const real_t sign = is_upper ? 1.0 : -1.0;
      const real_t bulge =
         (x * x + y * y) / (2.0 * (is_upper ? upper_radius : lower_radius));
      coordinate(0) = x;
      coordinate(1) = y;
      coordinate(2) = sign * (Graded(depth) + (1.0 - depth) * bulge);
   }
   return DistributeStack(mesh, MPI_COMM_WORLD);
}

// What the outer faces do.
void FarField(const Vector &x, Vector &u)
{
   const Hertz hertz;
   const real_t mu = young / (2.0 * (1.0 + poisson));
   const real_t scale = hertz.force / (4.0 * pi * mu);
   const real_t depth = std::abs(x[2]);
   const real_t r = std::hypot(x[0], x[1]);
   const real_t rho = std::hypot(r, depth);
   const real_t outward =
      scale * (depth / (rho * rho * rho) -
               (1.0 - 2.0 * poisson) / (rho * (rho + depth)));
   const real_t inward =
      scale * (depth * depth / (rho * rho * rho) + 2.0 * (1.0 - poisson) / rho);
   u[0] = outward * x[0];
   u[1] = outward * x[1];
   u[2] = x[2] < 0.0 ? -inward : inward - hertz.approach;
}

struct Errors
{
   real_t force = 0.0;
   real_t radius = 0.0;
   /// Of the radius that belongs to the contact area.
   real_t area_radius = 0.0;
   real_t peak = 0.0;
};

Errors Solve(int lower_cells, int upper_cells)
{
   NamedMesh mesh = MakeBodies(lower_cells, upper_cells);
   const IsotropicElastic solid(young, poisson);
   const ConstantPermeability permeability(1.0);
   BiphasicProblem problem(mesh, SpaceOptions());
   VectorFunctionCoefficient far_field(3, FarField);
   for (const std::string body : {"lower", "upper"})
   {
      problem.SetMaterial(body, solid, permeability);
      const std::string outer = body == "lower" ? "_z0" : "_z1";
      for (const std::string face : {"_x1", "_y1", outer.c_str()})
      {
         problem.Conditions().PrescribeDisplacement(mesh.Boundary(body + face),
                                                    far_field);
         problem.PrescribePressure(body + face, 0.0);
      }
      problem.PrescribeDisplacement(body + "_x0", 0, 0.0);
      problem.PrescribeDisplacement(body + "_y0", 1, 0.0);
   }
   ContactOptions contact;
   contact.gap_tolerance = 1e-4 * Hertz().approach;
   problem.AddContact("upper_z0", "lower_z1", contact);
   TimeOptions times;
   // Far more than the gel time size^2/(H_A kappa).
   times.step = times.end = 1e8;
   TimeStepper stepper(problem, times);
   const StepReport report = stepper.Step();
   INFO(report.reason);
   REQUIRE(report.converged);

   const ContactPair &pair = *problem.Operator().Pairs().front();
   const ContactDiagnostics now = Diagnose(pair);
   CHECK(stepper.Pressure().Normlinf() < 1e-6 * now.peak_traction);
   const Hertz hertz;
   Errors errors;
   errors.force = 4.0 * now.source_force[2] / hertz.force - 1.0;
   errors.radius =
      std::sqrt(2.5 * MeasureTraction(problem).mean_square_radius) / a - 1.0;
   errors.area_radius = std::sqrt(4.0 * now.area / pi) / a - 1.0;
   errors.peak = now.peak_traction / hertz.peak - 1.0;
   return errors;
}
} // namespace

TEST_CASE("Force, radius, area and peak pressure of Hertz's contact")
{
   // The lower body is the destination, and the finer one.
   const Errors coarse = Solve(6, 5);
   const Errors middle = Solve(9, 7);
   const Errors fine = Solve(13, 10);
   CAPTURE(coarse.force, coarse.radius, coarse.area_radius, coarse.peak);
   CAPTURE(middle.force, middle.radius, middle.area_radius, middle.peak);
   CAPTURE(fine.force, fine.radius, fine.area_radius, fine.peak);
   CHECK(std::abs(fine.force) <= 0.002);
   CHECK(std::abs(fine.radius) <= 0.015);
   CHECK(std::abs(fine.area_radius) <= 0.01);
   CHECK(std::abs(fine.peak) <= 0.015);
   CHECK(std::abs(fine.force) < std::abs(coarse.force));
   CHECK(std::abs(fine.radius) < std::abs(coarse.radius));
   CHECK(std::abs(fine.area_radius) < std::abs(middle.area_radius));
   CHECK(std::abs(middle.area_radius) < std::abs(coarse.area_radius));
   CHECK(std::abs(fine.peak) < std::abs(coarse.peak));
}
