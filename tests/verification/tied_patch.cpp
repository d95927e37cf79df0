// ranks: 1 2 3
// timeout: 300
//
// Patch tests of ties: two boxes glued on top of each other, with meshes that
// do not match, under loads for which the exact solution is in their spaces.
//
// Uniform stress, with shear: the strains along the interface, a, b and c, are
// those of both boxes; the others follow in each from the stresses across it,
//
//     u_x = a x + c y + tau z / mu,  u_y = c x + b y,
//     u_z = (sigma - lambda (a + b)) z / (lambda + 2 mu)
//
// and go on continuously in the upper one. All other sides are displaced like
// that, so that the rim of the interface is prescribed; or, with one solid,
// they bear the tractions of the stress, so that it is free.
//
// Pressure that falls linearly through both boxes, on rollers, is in balance
// with a quadratic displacement: (t + p)/H = u_z', as in the contact patch
// test.
//
// In finite deformation, a uniform deformation gradient of one solid.

#include "support/boxes.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t width = 1.0;
constexpr real_t lower_height = 0.6;
constexpr real_t upper_height = 0.5;
constexpr real_t permeability = 4.0e-3;
// Steps of hundreds of gel times h^2 / (H_A kappa).
constexpr real_t long_step = 1.0e5;
constexpr int long_steps = 6;
const std::vector<std::string> sides = {"x0", "x1", "y0", "y1"};

using Field = std::function<void(const Vector &, Vector &)>;

struct Bodies
{
   Element::Type type = Element::HEXAHEDRON;
   int order = 2;
   std::array<int, 2> cells{{2, 3}};
   LinearMethod method = LinearMethod::direct;

   NamedMesh Make() const
   {
      BoxOptions lower;
      lower.nx = cells[0];
      lower.ny = cells[0];
      lower.nz = 2;
      lower.type = type;
      lower.size_x = width;
      lower.size_y = width;
      lower.size_z = lower_height;
      BoxOptions upper = lower;
      upper.nx = cells[1];
      upper.ny = cells[1];
      upper.size_z = upper_height;
      return MakeStack(lower, upper);
   }
};

TieOptions Tight()
{
   TieOptions tie;
   tie.displacement_tolerance = 1e-13;
   tie.pressure_tolerance = 1e-9;
   return tie;
}

NonlinearOptions Exactly(LinearMethod method)
{
   NonlinearOptions nonlinear;
   nonlinear.linear.method = method;
   nonlinear.linear.relative_tolerance = 1e-11;
   return nonlinear;
}

TimeOptions LongSteps(int steps)
{
   TimeOptions times;
   times.step = long_step;
   times.end = steps * long_step;
   return times;
}

const TiedInterface &TieOf(BiphasicProblem &problem)
{
   return *problem.Operator().Interfaces().front();
}

void March(TimeStepper &stepper)
{
   while (!stepper.Done())
   {
      const StepReport report = stepper.Step();
      CAPTURE(report.reason, report.time);
      REQUIRE(report.converged);
   }
}

/// Largest error of the displacement at the nodes (length).
real_t DisplacementError(BiphasicProblem &problem, TimeStepper &stepper,
                         const Field &lower, const Field &upper)
{
   VectorFunctionCoefficient below(3, lower);
   VectorFunctionCoefficient above(3, upper);
   PWVectorCoefficient exact(3);
   exact.UpdateCoefficient(1, below);
   exact.UpdateCoefficient(2, above);
   ParGridFunction error(&problem.Spaces().Displacement());
   error.ProjectCoefficient(exact);
   error -= stepper.Displacement();
   return MaxOverRanks(error.Size() > 0 ? error.Normlinf() : 0.0,
                       problem.Mesh().GetComm());
}

/// Largest error of a component of the traction at the vertices that have one.
real_t TractionError(const TiedInterface &tie, int component, real_t exact)
{
   real_t error = 0.0;
   const Vector &area = tie.Operators().area[component];
   for (int j = 0; j < area.Size(); j++)
   {
      const real_t found = tie.State().acting.traction[component][j];
      error = std::max(error, area[j] > 0.0 ? std::abs(found - exact) : 0.0);
   }
   return MaxOverRanks(error, tie.Source().Spaces().GetComm());
}

/// Forces and moments of both sides, which cancel.
void CheckBalance(BiphasicProblem &problem, TimeStepper &stepper,
                  real_t tolerance)
{
   const TieDiagnostics now =
      Diagnose(TieOf(problem), stepper.State().GetBlock(0));
   const real_t force = Length(now.destination_force);
   CHECK(force > 0.0);
   CHECK(Length(Sum(now.source_force, 1.0, now.destination_force)) <=
         1e-12 * force);
   CHECK(Length(Sum(now.source_moment, 1.0, now.destination_moment)) <=
         tolerance * force * width);
}

/// Uniform stress with shear.
struct UniformStress
{
   UniformStress(real_t young_, real_t poisson)
   {
      mu = 0.5 * young_ / (1.0 + poisson);
      lambda = young_ * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
   }

   static constexpr real_t a = 0.01;
   static constexpr real_t b = -0.004;
   static constexpr real_t c = 0.006;
   static constexpr real_t normal = -0.02;
   static constexpr real_t shear = 0.005;

   real_t Along() const
   {
      return (normal - lambda * (a + b)) / (lambda + 2.0 * mu);
   }
   /// What a height adds.
   Point3 Rise(real_t height) const
   {
      return {shear / mu * height, 0.0, Along() * height};
   }
   /// sigma n
   Vector Traction(const Point3 &n) const
   {
      const real_t trace = lambda * (a + b + Along());
      const real_t stress[3][3] = {{trace + 2.0 * mu * a, 2.0 * mu * c, shear},
                                   {2.0 * mu * c, trace + 2.0 * mu * b, 0.0},
                                   {shear, 0.0, normal}};
      Vector traction(3);
      for (int i = 0; i < 3; i++)
      {
         traction[i] =
            stress[i][0] * n[0] + stress[i][1] * n[1] + stress[i][2] * n[2];
      }
      return traction;
   }

   real_t mu;
   real_t lambda;
};

void SetPlane(const Vector &x, const Point3 &rise, Vector &u)
{
   using S = UniformStress;
   u[0] = S::a * x[0] + S::c * x[1] + rise[0];
   u[1] = S::c * x[0] + S::b * x[1] + rise[1];
   u[2] = rise[2];
}

void CheckUniformStress(const Bodies &bodies, bool free, real_t tolerance)
{
   NamedMesh mesh = bodies.Make();
   const IsotropicElastic lower_solid(0.5, 0.3);
   const IsotropicElastic upper_solid(free ? 0.5 : 2.0, free ? 0.3 : 0.1);
   const UniformStress lower(0.5, 0.3);
   const UniformStress upper(free ? 0.5 : 2.0, free ? 0.3 : 0.1);
   const ConstantPermeability fluid(permeability);
   SpaceOptions space;
   space.order = bodies.order;
   BiphasicProblem problem(mesh, space);
   problem.SetMaterial("lower", lower_solid, fluid);
   problem.SetMaterial("upper", upper_solid, fluid);
   const Field below = [&](const Vector &x, Vector &u)
   { SetPlane(x, lower.Rise(x[2]), u); };
   const Field above = [&](const Vector &x, Vector &u)
   {
      SetPlane(
         x, Sum(lower.Rise(lower_height), 1.0, upper.Rise(x[2] - lower_height)),
         u);
   };
   VectorFunctionCoefficient below_field(3, below);
   VectorFunctionCoefficient above_field(3, above);
   BoundaryConditions &conditions = problem.Conditions();
   const std::vector<std::pair<std::string, Point3>> normals = {
      {"x0", {{-1.0, 0.0, 0.0}}},
      {"x1", {{1.0, 0.0, 0.0}}},
      {"y0", {{0.0, -1.0, 0.0}}},
      {"y1", {{0.0, 1.0, 0.0}}}};
   for (const auto &[side, normal] : normals)
   {
      problem.PrescribePressure("lower_" + side, 0.0);
      problem.PrescribePressure("upper_" + side, 0.0);
      if (free)
      {
         problem.AddTraction("lower_" + side, lower.Traction(normal), 1.0);
         problem.AddTraction("upper_" + side, upper.Traction(normal), 1.0);
      }
      else
      {
         conditions.PrescribeDisplacement(mesh.Boundary("lower_" + side),
                                          below_field);
         conditions.PrescribeDisplacement(mesh.Boundary("upper_" + side),
                                          above_field);
      }
   }
   conditions.PrescribeDisplacement(mesh.Boundary("lower_z0"), below_field);
   problem.PrescribePressure("lower_z0", 0.0);
   problem.PrescribePressure("upper_z1", 0.0);
   if (free)
   {
      problem.AddTraction("upper_z1", upper.Traction({{0.0, 0.0, 1.0}}), 1.0);
   }
   else
   {
      conditions.PrescribeDisplacement(mesh.Boundary("upper_z1"), above_field);
   }
   problem.AddTie({"upper_z0"}, {"lower_z1"}, Tight());
   problem.SetNonlinearOptions(Exactly(bodies.method));
   TimeStepper stepper(problem, LongSteps(long_steps));
   March(stepper);

   CHECK(DisplacementError(problem, stepper, below, above) <=
         tolerance * 0.01 * width);
   const TiedInterface &tie = TieOf(problem);
   CHECK(tie.Operators().covered == Approx(1.0).epsilon(1e-10));
   CHECK(tie.Operators().distance <= 1e-12);
   const real_t scale = 0.02;
   // Multipliers of what is jagged change the displacement least.
   const real_t of_tractions = 1e2 * tolerance * scale;
   CHECK(TractionError(tie, 0, UniformStress::shear) <= of_tractions);
   CHECK(TractionError(tie, 1, 0.0) <= of_tractions);
   CHECK(TractionError(tie, 2, UniformStress::normal) <= of_tractions);
   CheckBalance(problem, stepper, tolerance);
}

void CheckLinearPressure(const Bodies &bodies, real_t tolerance)
{
   constexpr real_t descent = 0.05;
   constexpr real_t top_pressure = 0.1;
   NamedMesh mesh = bodies.Make();
   const IsotropicElastic lower_solid(0.5, 0.3);
   const IsotropicElastic upper_solid(0.9, 0.2);
   const ConstantPermeability fluid(permeability);
   SpaceOptions space;
   space.order = bodies.order;
   BiphasicProblem problem(mesh, space);
   problem.SetMaterial("lower", lower_solid, fluid);
   problem.SetMaterial("upper", upper_solid, fluid);
   for (const std::string body : {"lower_", "upper_"})
   {
      problem.PrescribeDisplacement(body + "x0", 0, 0.0);
      problem.PrescribeDisplacement(body + "x1", 0, 0.0);
      problem.PrescribeDisplacement(body + "y0", 1, 0.0);
      problem.PrescribeDisplacement(body + "y1", 1, 0.0);
   }
   problem.PrescribeDisplacement("lower_z0", 2, 0.0);
   problem.PrescribeDisplacement("upper_z1", 2, -descent);
   problem.PrescribePressure("lower_z0", 0.0);
   problem.PrescribePressure("upper_z1", top_pressure);
   problem.AddTie({"upper_z0"}, {"lower_z1"}, Tight());
   problem.SetNonlinearOptions(Exactly(bodies.method));
   TimeStepper stepper(problem, LongSteps(long_steps));
   March(stepper);

   const real_t height = lower_height + upper_height;
   const real_t slope = top_pressure / height;
   const real_t h1 = lower_solid.AggregateModulus();
   const real_t h2 = upper_solid.AggregateModulus();
   const auto integral =
      [&](real_t from, real_t to, real_t modulus, real_t traction)
   {
      return (traction * (to - from) + 0.5 * slope * (to * to - from * from)) /
             modulus;
   };
   const real_t swelling = integral(0.0, lower_height, h1, 0.0) +
                           integral(lower_height, height, h2, 0.0);
   const real_t traction =
      -(descent + swelling) / (lower_height / h1 + upper_height / h2);
   const auto below = [&](const Vector &x, Vector &u)
   {
      u = 0.0;
      u[2] = integral(0.0, x[2], h1, traction);
   };
   const auto above = [&](const Vector &x, Vector &u)
   {
      u = 0.0;
      u[2] = integral(0.0, lower_height, h1, traction) +
             integral(lower_height, x[2], h2, traction);
   };
   CHECK(DisplacementError(problem, stepper, below, above) <=
         tolerance * descent);
   FunctionCoefficient exact([&](const Vector &x) { return slope * x[2]; });
   ParGridFunction error(&problem.Spaces().Pressure());
   error.ProjectCoefficient(exact);
   error -= stepper.Pressure();
   CHECK(MaxOverRanks(error.Size() > 0 ? error.Normlinf() : 0.0,
                      mesh.GetComm()) <= tolerance * top_pressure);
   const TieDiagnostics now =
      Diagnose(TieOf(problem), stepper.State().GetBlock(0));
   CHECK(now.fluid_exchange ==
         Approx(permeability * slope * width * width).epsilon(tolerance));
   CHECK(now.destination_force[2] ==
         Approx(traction * width * width).epsilon(tolerance));
   CheckBalance(problem, stepper, tolerance);
}

void CheckFinite(const Bodies &bodies, real_t tolerance)
{
   NamedMesh mesh = bodies.Make();
   const NeoHookean solid(0.5, 0.2);
   const ConstantPermeability fluid(permeability);
   SpaceOptions space;
   space.order = bodies.order;
   space.deformation = Deformation::finite;
   BiphasicProblem problem(mesh, space);
   problem.SetMaterial("lower", solid, fluid);
   problem.SetMaterial("upper", solid, fluid);
   // Compressed to 0.7 along z and sheared, within four steps, and held.
   constexpr int strains = 4;
   const auto deform = [](real_t t, const Vector &x, Vector &u)
   {
      const real_t part = std::min(1.0, t / (strains * long_step));
      u[0] = part * (0.1 * x[0] + 0.3 * x[2]);
      u[1] = part * (-0.1 * x[1] + 0.05 * x[0]);
      u[2] = part * (-0.3 * x[2]);
   };
   VectorFunctionCoefficient field(3, [&](const Vector &x, real_t t, Vector &u)
                                   { deform(t, x, u); });
   BoundaryConditions &conditions = problem.Conditions();
   for (const std::string body : {"lower_", "upper_"})
   {
      for (const std::string &side : sides)
      {
         conditions.PrescribeDisplacement(mesh.Boundary(body + side), field);
         problem.PrescribePressure(body + side, 0.0);
      }
   }
   conditions.PrescribeDisplacement(mesh.Boundary("lower_z0"), field);
   conditions.PrescribeDisplacement(mesh.Boundary("upper_z1"), field);
   problem.AddTie({"upper_z0"}, {"lower_z1"}, Tight());
   problem.SetNonlinearOptions(Exactly(bodies.method));
   TimeStepper stepper(problem, LongSteps(strains + long_steps));
   while (!stepper.Done())
   {
      const StepReport report = stepper.Step();
      CAPTURE(report.reason, report.time);
      REQUIRE(report.converged);
      // Each but leaves a tenth of the jumps, which are to be next to nothing.
      CHECK(report.solve.newton <= 12);
   }
   const Field exact = [&](const Vector &x, Vector &u)
   { deform(strains * long_step, x, u); };
   CHECK(DisplacementError(problem, stepper, exact, exact) <=
         tolerance * 0.3 * width);
   CheckBalance(problem, stepper, tolerance);
}

std::string Describe(const Bodies &bodies)
{
   return "element type " + std::to_string(bodies.type) + ", order " +
          std::to_string(bodies.order) + ", cells " +
          std::to_string(bodies.cells[0]) + " and " +
          std::to_string(bodies.cells[1]) + ", solver " +
          std::to_string(static_cast<int>(bodies.method));
}

std::vector<Bodies> AllBodies(int least_order)
{
   std::vector<Bodies> all;
   for (const Element::Type type :
        {Element::HEXAHEDRON, Element::TETRAHEDRON, Element::WEDGE})
   {
      for (int order = least_order; order <= (type == Element::WEDGE ? 2 : 3);
           order++)
      {
         for (const std::array<int, 2> &cells :
              {std::array<int, 2>{{2, 3}}, std::array<int, 2>{{3, 2}}})
         {
            if (order < 3 || cells[0] == 2)
            {
               all.push_back({type, order, cells, LinearMethod::direct});
            }
         }
      }
   }
   return all;
}

// Ten times what has been seen.
constexpr real_t solved = 1e-9;
} // namespace

TEST_CASE("Uniform stress passes a tie, with shear, and a prescribed rim")
{
   for (const Bodies &bodies : AllBodies(1))
   {
      INFO(Describe(bodies));
      CheckUniformStress(bodies, false, solved);
   }
}

TEST_CASE("Uniform stress passes a tie with a free rim")
{
   for (const Bodies &bodies : AllBodies(1))
   {
      INFO(Describe(bodies));
      CheckUniformStress(bodies, true, solved);
   }
}

TEST_CASE("Pressure that falls linearly passes a tie")
{
   for (const Bodies &bodies : AllBodies(2))
   {
      INFO(Describe(bodies));
      CheckLinearPressure(bodies, solved);
   }
}

TEST_CASE("A uniform finite deformation passes a tie")
{
   for (const Bodies &bodies : AllBodies(1))
   {
      if (bodies.order < 3)
      {
         INFO(Describe(bodies));
         CheckFinite(bodies, solved);
      }
   }
}

TEST_CASE("The multigrid solver passes the same tests")
{
   Bodies bodies;
   bodies.method = LinearMethod::block_amg;
   for (const int order : {1, 2})
   {
      bodies.order = order;
      INFO(Describe(bodies));
      CheckUniformStress(bodies, false, solved);
      CheckUniformStress(bodies, true, solved);
      CheckFinite(bodies, solved);
   }
   CheckLinearPressure(bodies, solved);
}
