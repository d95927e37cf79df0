// ranks: 1 2 3
// timeout: 300
//
// Mandel's slab (1953): |x| <= a, plane strain in y, between rigid,
// frictionless, impermeable plates that press it along z with the force 2F per
// length in y from t = 0 on; p = 0 at x = +-a. The strain e(t) along z is
// uniform and p depends on x and t only. With incompressible constituents (nu_u
// = 1/2, B = 1) the solution of Cheng & Detournay (1988) is, with tan(alpha) =
// (1-nu)/(1/2-nu) alpha, D = alpha - sin(alpha) cos(alpha) and E = exp(-alpha^2
// c t/a^2), c = H_A kappa,
//
//    p(x,t) = (F/a) sum sin(alpha)/D (cos(alpha x/a) - cos(alpha)) E,
//    e(t)   = -F(1-nu)/(2 mu a) + F/(2 mu a) sum sin(alpha) cos(alpha)/D E.
//
// A rigid plate that is driven by its resultant is not what prescribed boundary
// values can say. So the plate's displacement is prescribed as e(t) says; then
// the problem has the same solution, and the force comes out. The other way, a
// uniform traction through a layer of stiff material, would make an error of
// the order of the ratio of the stiffnesses, and such a layer would have to
// slide on the slab.

#include "support/march.hpp"
#include "support/reference_table.hpp"
#include "synovia/synovia.hpp"

#include "synovia/general/reduce.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t half_width = 1.0;
constexpr real_t half_force = 0.02;
constexpr real_t depth = 0.05;
constexpr real_t height = 0.05;
constexpr real_t young = 0.5417;
constexpr real_t poisson = 0.0833;
constexpr real_t permeability_value = 4.0e-3;

/// The series above, for c t/a^2 of 1e-5 and more.
class Mandel
{
public:
   Mandel()
   {
      const real_t ratio = (1.0 - poisson) / (0.5 - poisson);
      // One root in each (i pi, i pi + pi/2).
      for (int i = 0; i < terms; i++)
      {
         real_t low = i * M_PI + 1e-6;
         real_t high = (i + 0.5) * M_PI;
         for (int bisection = 0; bisection < 60; bisection++)
         {
            const real_t middle = 0.5 * (low + high);
            // Of the sign of tan(x) - ratio x, without its poles.
            const real_t value =
               (std::sin(middle) - ratio * middle * std::cos(middle)) *
               std::cos(middle);
            (value > 0.0 ? high : low) = middle;
         }
         roots.push_back(0.5 * (low + high));
      }
   }

   real_t Pressure(real_t x, real_t t) const
   {
      real_t sum = 0.0;
      for (const real_t a : roots)
      {
         sum += std::sin(a) / Denominator(a) *
                (std::cos(a * x / half_width) - std::cos(a)) * Decay(a, t);
      }
      return half_force / half_width * sum;
   }

   real_t Strain(real_t t) const
   {
      real_t sum = 0.0;
      for (const real_t a : roots)
      {
         sum += std::sin(a) * std::cos(a) / Denominator(a) * Decay(a, t);
      }
      return half_force / (2.0 * mu * half_width) * (sum - (1.0 - poisson));
   }

private:
   static real_t Denominator(real_t a) { return a - std::sin(a) * std::cos(a); }
   real_t Decay(real_t a, real_t t) const
   {
      return std::exp(-a * a * diffusivity * t / (half_width * half_width));
   }

   static constexpr int terms = 600;
   const real_t mu = young / (2.0 * (1.0 + poisson));
   const real_t diffusivity =
      permeability_value * 2.0 * mu * (1.0 - poisson) / (1.0 - 2.0 * poisson);
   std::vector<real_t> roots;
};

/// The plate's displacement, in points so dense that straight lines between
/// them do: 1e-6 of it off.
LoadCurve PlateDisplacement(const Mandel &exact, real_t first, real_t end)
{
   std::vector<real_t> times;
   std::vector<real_t> values;
   for (real_t t = first; t < 1.01 * end; t *= 1.01)
   {
      times.push_back(t);
      values.push_back(height * exact.Strain(t));
   }
   return LoadCurve(times, values);
}

/// 0 <= x <= a in elements that get narrower towards the drained side.
NamedMesh MakeSlab(Element::Type type)
{
   Mesh mesh = Mesh::MakeCartesian3D(36, 1, 1, type, half_width, depth, height);
   for (int i = 0; i < mesh.GetNV(); i++)
   {
      real_t &x = mesh.GetVertex(i)[0];
      x = half_width * (1.0 - std::pow(1.0 - x / half_width, 1.7));
   }
   return DistributeMesh(mesh, {{"slab", {1}}},
                         {{"bottom", {1}},
                          {"ends", {2, 4}},
                          {"side", {3}},
                          {"middle", {5}},
                          {"top", {6}}},
                         MPI_COMM_WORLD);
}
} // namespace

TEST_CASE("Mandel's series is that of the reference table")
{
   const Mandel exact;
   const ReferenceTable reference("mandel.csv");
   REQUIRE(reference.Rows() == 88);
   for (int row = 0; row < reference.Rows(); row++)
   {
      const real_t t = reference.Get(row, "t");
      CHECK(exact.Pressure(reference.Get(row, "x"), t) ==
            Approx(reference.Get(row, "p")).epsilon(1e-8).margin(1e-12));
      CHECK(exact.Strain(t) ==
            Approx(reference.Get(row, "eps_z")).epsilon(1e-8));
   }
}

TEST_CASE("Pressure, width and force of Mandel's slab are within 0.5 %")
{
   const auto type = GENERATE(Element::HEXAHEDRON, Element::TETRAHEDRON);
   NamedMesh mesh = MakeSlab(type);
   const IsotropicElastic solid(young, poisson);
   const ConstantPermeability permeability(permeability_value);
   const Mandel exact;
   const real_t first = 0.02;
   BiphasicProblem problem(mesh, SpaceOptions());
   problem.SetMaterial("slab", solid, permeability);
   problem.PrescribeDisplacement("middle", 0, 0.0);
   problem.PrescribeDisplacement("ends", 1, 0.0);
   problem.PrescribeDisplacement("bottom", 2, 0.0);
   problem.PrescribePressure("side", 0.0);
   problem.PrescribeDisplacement("top", 2,
                                 PlateDisplacement(exact, first, 400.0));

   const ReferenceTable reference("mandel.csv");
   March march(problem);
   // A short step for the undrained response, and then the rest.
   BackwardEulerSolver backward_euler;
   REQUIRE(march.Step(backward_euler, first));
   SDIRK33Solver sdirk33;
   for (const real_t end : {0.1, 1.0, 5.0, 20.0, 50.0, 100.0, 200.0, 400.0})
   {
      constexpr int steps = 5;
      const real_t dt = (end - march.Time()) / steps;
      for (int i = 0; i < steps; i++)
      {
         REQUIRE(march.Step(sdirk33, dt));
      }
      if (end < 1.0)
      {
         continue;
      }
      // Vertices come first among the dofs, which are ordered by node.
      real_t p_error = 0.0;
      real_t width = 0.0;
      for (int i = 0; i < mesh.Get().GetNV(); i++)
      {
         const real_t x = mesh.Get().GetVertex(i)[0];
         p_error = std::max(
            p_error, std::abs(march.Pressure()[i] - exact.Pressure(x, end)));
         if (x > half_width - 1e-9)
         {
            width = std::max(width, march.Displacement()[3 * i]);
         }
      }
      const real_t undrained = 0.5 * half_force / half_width;
      p_error = MaxOverRanks(p_error, MPI_COMM_WORLD) / undrained;
      width = MaxOverRanks(width, MPI_COMM_WORLD);
      const real_t force =
         -2.0 * problem.Reaction(problem.Supports().back())[2] / depth;
      CAPTURE(end, p_error);
      CHECK(p_error < 5e-3);
      CHECK(force == Approx(2.0 * half_force).epsilon(5e-3));
      CHECK(width ==
            Approx(reference.Find({{"t", end}, {"x", half_width}}, "ux_edge"))
               .epsilon(5e-3));
   }
}
