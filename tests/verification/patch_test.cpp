// ranks: 1 2 3 4
// timeout: 300
//
// Contact patch tests: two boxes on top of each other, with meshes that do not
// match, under loads for which the exact solution is uniform or linear.
//
// Sides on rollers and a long hold: the strain is uniaxial and the stress
// uniform. With the moduli H_1, H_2 and heights h_1, h_2 of lower and upper
// box,
//
//     t = -delta / (h_1/H_1 + h_2/H_2),   u_z = t z / H_1 in the lower box.
//
// With fluid that seeps from the top, where p = P, to the bottom, where p = 0,
// and one permeability, p = P z / (h_1 + h_2), the flux is uniform, and the
// total stress t too: H u_z' = t + p is linear, u_z quadratic, both of which
// elements of order 2 have.
//
// A curved interface, the paraboloid z = h_1 + c (x^2 + y^2), which meshes of
// order 2 have exactly: both bodies of one solid with the bulk modulus K shrink
// as one, u = -e x, so that the stress is -3 K e in all directions, and so is
// the traction normal to the interface.

#include "support/boxes.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <string>
#include <vector>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t width = 1.0;
constexpr real_t lower_height = 0.6;
constexpr real_t upper_height = 0.5;
constexpr real_t descent = 0.05;
constexpr real_t permeability = 4.0e-3;
// Thousands of gel times h^2 / (H_A kappa).
constexpr real_t long_time = 1.0e11;

struct Patch
{
   Element::Type type = Element::HEXAHEDRON;
   int order = 2;
   int lower_cells = 1;
   int upper_cells = 1;
   int quadrature_order = ContactOptions().quadrature_order;
   ContactNormal normal = ContactNormal::destination;
   real_t lower_poisson = 0.3;
   real_t upper_modulus = 0.9;
   real_t top_pressure = 0.0;
};

struct Errors
{
   // Largest error of the traction over the exact one.
   real_t traction = 0.0;
   // Of the vertical displacement over that of the top.
   real_t displacement = 0.0;
   // Of the pressure over that of the top.
   real_t pressure = 0.0;
   // Of the flux through the interface over the exact one.
   real_t flux = 0.0;
   // Of the forces on both sides against each other, over either.
   real_t balance = 0.0;
   real_t area = 0.0;
};

real_t MaxOver(MPI_Comm comm, real_t value)
{
   MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPITypeMap<real_t>::mpi_type, MPI_MAX,
                 comm);
   return value;
}

Mesh MakeBodies(const Patch &patch)
{
   BoxOptions lower;
   lower.nx = patch.lower_cells;
   lower.ny = patch.lower_cells;
   lower.nz = 2;
   lower.type = patch.type;
   lower.size_x = width;
   lower.size_y = width;
   lower.size_z = lower_height;
   BoxOptions upper = lower;
   upper.nx = patch.upper_cells;
   upper.ny = patch.upper_cells;
   upper.size_z = upper_height;
   return MakeStackMesh(lower, upper);
}

ContactOptions ContactOf(const Patch &patch)
{
   ContactOptions contact;
   contact.quadrature_order = patch.quadrature_order;
   contact.normal = patch.normal;
   contact.gap_tolerance = 1e-10;
   contact.pressure_tolerance = 1e-8;
   return contact;
}

/// One step, until all fluid has drained.
void Drain(BiphasicProblem &problem, TimeStepper &stepper)
{
   const StepReport report = stepper.Step();
   CAPTURE(report.reason);
   REQUIRE(report.converged);
   REQUIRE(HasTouched(*problem.Operator().Pairs().front()));
}

TimeOptions OneLongStep()
{
   TimeOptions times;
   times.step = long_time;
   times.end = long_time;
   return times;
}

NonlinearOptions Exactly()
{
   NonlinearOptions nonlinear;
   nonlinear.linear.method = LinearMethod::direct;
   nonlinear.linear.relative_tolerance = 1e-13;
   return nonlinear;
}

/// Largest error of the traction at the vertices of the destination, over all
/// ranks, relative to the exact one.
real_t TractionError(const ContactPair &pair, real_t exact, MPI_Comm comm)
{
   real_t error = 0.0;
   for (const real_t found : pair.State().traction)
   {
      error = std::max(error, std::abs(found / exact - 1.0));
   }
   return MaxOver(comm, error);
}

/// Of the forces on both sides against each other, over either.
real_t ImbalanceOf(const ContactDiagnostics &forces)
{
   real_t error = 0.0;
   for (int d = 0; d < 3; d++)
   {
      error = std::max(
         error, std::abs(forces.source_force[d] + forces.destination_force[d]) /
                   std::abs(forces.source_force[2]));
   }
   return error;
}

Errors Solve(const Patch &patch)
{
   Mesh bodies = MakeBodies(patch);
   NamedMesh mesh = DistributeStack(bodies, MPI_COMM_WORLD);

   const IsotropicElastic lower_solid(0.5, patch.lower_poisson);
   const IsotropicElastic upper_solid(patch.upper_modulus, 0.2);
   const ConstantPermeability fluid(permeability);
   SpaceOptions space;
   space.order = patch.order;
   BiphasicProblem problem(mesh, space);
   problem.SetMaterial("lower", lower_solid, fluid);
   problem.SetMaterial("upper", upper_solid, fluid);
   for (const char *body : {"lower_", "upper_"})
   {
      const std::string prefix = body;
      problem.PrescribeDisplacement(prefix + "x0", 0, 0.0);
      problem.PrescribeDisplacement(prefix + "x1", 0, 0.0);
      problem.PrescribeDisplacement(prefix + "y0", 1, 0.0);
      problem.PrescribeDisplacement(prefix + "y1", 1, 0.0);
   }
   problem.PrescribeDisplacement("lower_z0", 2, 0.0);
   problem.PrescribeDisplacement("upper_z1", 2, -descent);
   problem.PrescribePressure("lower_z0", 0.0);
   problem.PrescribePressure("upper_z1", patch.top_pressure);
   problem.AddContact("upper_z0", "lower_z1", ContactOf(patch));
   problem.SetNonlinearOptions(Exactly());
   TimeStepper stepper(problem, OneLongStep());
   Drain(problem, stepper);

   // div(sigma) = 0 and sigma = H u' - p: u' = (t + p) / H.
   const real_t height = lower_height + upper_height;
   const real_t slope = patch.top_pressure / height;
   const real_t h1 = lower_solid.AggregateModulus();
   const real_t h2 = upper_solid.AggregateModulus();
   const real_t flexibility = lower_height / h1 + upper_height / h2;
   const real_t swelling =
      0.5 * slope *
      (lower_height * lower_height / h1 +
       (height * height - lower_height * lower_height) / h2);
   const real_t traction = -(descent + swelling) / flexibility;
   const auto lower_u = [&](real_t z)
   { return (traction * z + 0.5 * slope * z * z) / h1; };
   const auto upper_u = [&](real_t z)
   {
      const real_t a = lower_height;
      return lower_u(a) +
             (traction * (z - a) + 0.5 * slope * (z * z - a * a)) / h2;
   };

   const MPI_Comm comm = mesh.GetComm();
   Errors errors;
   const ContactPair &pair = *problem.Operator().Pairs().front();
   errors.traction = TractionError(pair, traction, comm);

   VectorFunctionCoefficient exact_u(3,
                                     [&](const Vector &x, Vector &u)
                                     {
                                        u = 0.0;
                                        u[2] = lower_u(x[2]);
                                     });
   VectorFunctionCoefficient exact_upper_u(3,
                                           [&](const Vector &x, Vector &u)
                                           {
                                              u = 0.0;
                                              u[2] = upper_u(x[2]);
                                           });
   PWVectorCoefficient exact(3);
   exact.UpdateCoefficient(1, exact_u);
   exact.UpdateCoefficient(2, exact_upper_u);
   ParGridFunction u_error(&problem.Spaces().Displacement());
   u_error.ProjectCoefficient(exact);
   u_error -= stepper.Displacement();
   errors.displacement = MaxOver(comm, u_error.Normlinf()) / descent;
   if (patch.top_pressure != 0.0)
   {
      FunctionCoefficient exact_p([&](const Vector &x)
                                  { return slope * x[2]; });
      ParGridFunction p_error(&problem.Spaces().Pressure());
      p_error.ProjectCoefficient(exact_p);
      p_error -= stepper.Pressure();
      errors.pressure = MaxOver(comm, p_error.Normlinf()) / patch.top_pressure;
   }
   const ContactDiagnostics forces = Diagnose(pair);
   if (slope != 0.0)
   {
      errors.flux =
         std::abs(forces.fluid_exchange / (permeability * slope) - 1.0);
   }
   errors.balance = ImbalanceOf(forces);
   errors.area = forces.area;
   return errors;
}

constexpr real_t shrinkage = 0.01;
constexpr real_t curvature = 0.1;

void Bend(const Vector &x, Vector &y)
{
   y = x;
   const real_t part = x[2] < lower_height
                          ? x[2] / lower_height
                          : (lower_height + upper_height - x[2]) / upper_height;
   y[2] += part * curvature * (x[0] * x[0] + x[1] * x[1]);
}

void Shrink(const Vector &x, Vector &u)
{
   u.Set(-shrinkage, x);
}

/// With the curved interface.
Errors SolveCurved(const Patch &patch)
{
   Mesh bodies = MakeBodies(patch);
   bodies.SetCurvature(2);
   bodies.Transform(Bend);
   NamedMesh mesh = DistributeStack(bodies, MPI_COMM_WORLD);
   const IsotropicElastic solid(0.5, 0.3);
   const ConstantPermeability fluid(permeability);
   BiphasicProblem problem(mesh, SpaceOptions());
   VectorFunctionCoefficient exact(3, Shrink);
   for (const std::string body : {"lower", "upper"})
   {
      problem.SetMaterial(body, solid, fluid);
      for (const std::string face :
           {"_x0", "_x1", "_y0", "_y1", body == "lower" ? "_z0" : "_z1"})
      {
         problem.Conditions().PrescribeDisplacement(mesh.Boundary(body + face),
                                                    exact);
         problem.PrescribePressure(body + face, 0.0);
      }
   }
   problem.AddContact("upper_z0", "lower_z1", ContactOf(patch));
   problem.SetNonlinearOptions(Exactly());
   TimeStepper stepper(problem, OneLongStep());
   Drain(problem, stepper);

   const MPI_Comm comm = mesh.GetComm();
   Errors errors;
   const ContactPair &pair = *problem.Operator().Pairs().front();
   // E / (1 - 2 nu) = 3 K
   errors.traction =
      TractionError(pair, -shrinkage * 0.5 / (1.0 - 2.0 * 0.3), comm);
   ParGridFunction u_error(&problem.Spaces().Displacement());
   u_error.ProjectCoefficient(exact);
   u_error -= stepper.Displacement();
   errors.displacement = MaxOver(comm, u_error.Normlinf()) / shrinkage;
   errors.balance = ImbalanceOf(Diagnose(pair));
   return errors;
}

// What is left of the tolerance of the contact and of round-off in a step of
// thousands of gel times; it is ten times what has been seen on 1 to 4 ranks.
constexpr real_t solved = 5e-9;
constexpr real_t top_pressure = 0.1;

void CheckBalance(const Errors &errors)
{
   CHECK(errors.balance <= 1e-10);
   CHECK(errors.area == Approx(width * width).epsilon(1e-10));
}

Patch MakePatch(const std::array<int, 2> &cells)
{
   Patch patch;
   patch.type = GENERATE(Element::HEXAHEDRON, Element::TETRAHEDRON);
   patch.lower_cells = cells[0];
   patch.upper_cells = cells[1];
   return patch;
}

std::string Describe(const Patch &patch)
{
   return (patch.type == Element::HEXAHEDRON ? "hexahedra" : "tetrahedra") +
          std::string(", order ") + std::to_string(patch.order) + ", " +
          std::to_string(patch.lower_cells) + ":" +
          std::to_string(patch.upper_cells);
}
} // namespace

TEST_CASE("Meshes that do not match pass the patch test to round-off")
{
   // The finer body below and above, and meshes that match.
   const std::array<int, 2> cells =
      GENERATE(std::array<int, 2>{2, 3}, std::array<int, 2>{4, 3},
               std::array<int, 2>{5, 7}, std::array<int, 2>{3, 3});
   Patch patch = MakePatch(cells);
   patch.order = GENERATE(1, 2);
   INFO(Describe(patch));
   const Errors errors = Solve(patch);
   CHECK(errors.traction <= solved);
   CHECK(errors.displacement <= solved);
   CheckBalance(errors);
}

TEST_CASE("Mean normals pass the patch test")
{
   Patch patch = MakePatch({{2, 3}});
   patch.normal = ContactNormal::mean;
   INFO(Describe(patch));
   const Errors errors = Solve(patch);
   CHECK(errors.traction <= solved);
   CHECK(errors.displacement <= solved);
   CheckBalance(errors);
}

TEST_CASE("A curved interface passes the patch test")
{
   const std::array<int, 2> cells =
      GENERATE(std::array<int, 2>{2, 3}, std::array<int, 2>{4, 3});
   Patch patch = MakePatch(cells);
   patch.normal = GENERATE(ContactNormal::destination, ContactNormal::mean);
   INFO(Describe(patch));
   const Errors errors = SolveCurved(patch);
   // The quadrature of curved elements and segments is not exact: ten times
   // what has been seen on 1 to 4 ranks.
   CHECK(errors.traction <= 4e-5);
   CHECK(errors.displacement <= 3e-7);
   CHECK(errors.balance <= 1e-10);
}

TEST_CASE("The patch test converges with the order of the quadrature")
{
   Patch patch = MakePatch({{3, 4}});
   patch.order = 2;
   const auto error = [&](int quadrature_order)
   {
      patch.quadrature_order = quadrature_order;
      INFO(Describe(patch) << ", quadrature order " << quadrature_order);
      const Errors errors = Solve(patch);
      CheckBalance(errors);
      return errors.traction;
   };
   // A point a segment can't tell displacements of order 2 apart; on squares
   // their integrals are of degree 4.
   const real_t first = error(1);
   CHECK(first > 1e3 * solved);
   CHECK(error(2) < 0.5 * first);
   CHECK(error(4) <= solved);
}

TEST_CASE("A linear pressure passes through the interface")
{
   const std::array<int, 2> cells =
      GENERATE(std::array<int, 2>{2, 3}, std::array<int, 2>{4, 3},
               std::array<int, 2>{3, 3});
   Patch patch = MakePatch(cells);
   patch.top_pressure = top_pressure;
   INFO(Describe(patch));
   const Errors errors = Solve(patch);
   CHECK(errors.traction <= solved);
   CHECK(errors.displacement <= solved);
   CHECK(errors.pressure <= solved);
   CHECK(errors.flux <= solved);
   CheckBalance(errors);
}
