// ranks: 1 2 3
// timeout: 300
//
// Manufactured solutions at strains of 30 %: u = f(t) U(X) and p = f(t) P(X) on
// the unit cube, of the law of Holmes & Mow and a permeability that closes.
// Body force and fluid source per undeformed volume follow from
//
//    b = -Div(P_e(F) - p cof F) = -dP_e/dF : Grad F + cof F Grad p,
//    s = dJ/dt - Div(K Grad p),
//
// the cofactor having no divergence. Displacement is prescribed on four sides,
// traction (dead, per undeformed area) on two; pressure on two, flux on four.
// With J - J_old in place of dt dJ/dt the steps of backward Euler are exact,
// and what is left is the error in space, in L2, with the orders of the
// infinitesimal problem (manufactured.cpp has them, and why displacement is
// prescribed all around for the order 3):
//
//                              u       p
//    order 3                   4        3
//    order 2, undrained        3        2
//    order 2, drained          2        2
//    order 1, stabilized       2     >= 1

#include "support/boxes.hpp"
#include "synovia/fem/strain_monitor.hpp"
#include "synovia/materials/permeabilities/holmes_mow_permeability.hpp"
#include "synovia/materials/solids/holmes_mow.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <functional>
#include <memory>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr int steps = 2;
constexpr real_t step = 1.0 / steps;

using Triple = std::array<real_t, 3>;

/// U_i = A_i sin(a.x + i), P = B cos(b.x), both times t.
struct Waves
{
   const Triple amplitude{{0.11, -0.09, 0.12}};
   const Triple a{{2.0, 1.5, -1.0}};
   const Triple b{{1.2, -1.6, 2.0}};
   const real_t pressure = 0.15;

   real_t Phase(const Vector &x, int i) const
   {
      return a[0] * x[0] + a[1] * x[1] + a[2] * x[2] + i;
   }
   real_t PressurePhase(const Vector &x) const
   {
      return b[0] * x[0] + b[1] * x[1] + b[2] * x[2];
   }
   real_t U(const Vector &x, int i) const
   {
      return amplitude[i] * std::sin(Phase(x, i));
   }
   real_t P(const Vector &x) const
   {
      return pressure * std::cos(PressurePhase(x));
   }
   Tensor3<> DeformationGradient(const Vector &x, real_t t) const
   {
      Tensor3<> F = IdentityTensor();
      for (int k = 0; k < 9; k++)
      {
         F[k / 3][k % 3] +=
            t * amplitude[k / 3] * a[k % 3] * std::cos(Phase(x, k / 3));
      }
      return F;
   }
   /// d F_kl / d x_j
   real_t Curvature(const Vector &x, real_t t, int k, int l, int j) const
   {
      return -t * a[l] * a[j] * U(x, k);
   }
   Vector3<> PressureGradient(const Vector &x, real_t t) const
   {
      const real_t s = -t * pressure * std::sin(PressurePhase(x));
      return {b[0] * s, b[1] * s, b[2] * s};
   }
   real_t PressureCurvature(const Vector &x, real_t t, int i, int j) const
   {
      return -t * b[i] * b[j] * P(x);
   }
};

struct Bodies
{
   explicit Bodies(real_t kappa) : permeability(kappa, 2.0, 2.0, 0.2) {}

   const Waves waves;
   const HolmesMow solid{1.3, 0.25, 0.5};
   const HolmesMowPermeability permeability;

   // P_e - p cof F
   Tensor3<> Stress(const MaterialPoint &point, const Vector &x, real_t t) const
   {
      const Tensor3<> F = waves.DeformationGradient(x, t);
      Tensor3<> stress;
      REQUIRE(solid.GetStress(point, F, stress, nullptr));
      return stress - t * waves.P(x) * Cofactor(F);
   }

   Vector3<> Force(const MaterialPoint &point, const Vector &x, real_t t) const
   {
      const Tensor3<> F = waves.DeformationGradient(x, t);
      Tensor3<> stress;
      Tangent3 tangent;
      REQUIRE(solid.GetStress(point, F, stress, &tangent));
      const Tensor3<> cofactor = Cofactor(F);
      const Vector3<> slope = waves.PressureGradient(x, t);
      Vector3<> force{};
      for (int i = 0; i < 3; i++)
      {
         for (int j = 0; j < 3; j++)
         {
            force[i] += cofactor[i][j] * slope[j];
            for (int k = 0; k < 9; k++)
            {
               force[i] -= tangent[3 * i + j][k] *
                           waves.Curvature(x, t, k / 3, k % 3, j);
            }
         }
      }
      return force;
   }

   Vector3<> Flow(const MaterialPoint &point, const Vector &x, real_t t) const
   {
      Tensor3<> K;
      REQUIRE(permeability.GetReferential(
         point, waves.DeformationGradient(x, t), K, nullptr));
      const Vector3<> slope = waves.PressureGradient(x, t);
      Vector3<> flow{};
      for (int k = 0; k < 9; k++)
      {
         flow[k / 3] -= K[k / 3][k % 3] * slope[k % 3];
      }
      return flow;
   }

   real_t Source(const MaterialPoint &point, const Vector &x, real_t t) const
   {
      const Tensor3<> F = waves.DeformationGradient(x, t);
      Tensor3<> K;
      Tangent3 tangent;
      REQUIRE(permeability.GetReferential(point, F, K, &tangent));
      const Vector3<> slope = waves.PressureGradient(x, t);
      real_t source =
         (det(F) - det(waves.DeformationGradient(x, t - step))) / step;
      for (int i = 0; i < 3; i++)
      {
         for (int j = 0; j < 3; j++)
         {
            source -= K[i][j] * waves.PressureCurvature(x, t, i, j);
            for (int k = 0; k < 9; k++)
            {
               source -= tangent[3 * i + j][k] *
                         waves.Curvature(x, t, k / 3, k % 3, i) * slope[j];
            }
         }
      }
      return source;
   }
};

Vector Place(ElementTransformation &trans, const IntegrationPoint &ip)
{
   Vector x(3);
   trans.Transform(ip, x);
   return x;
}

/// A vector of a member of Bodies.
class VectorOf : public VectorCoefficient
{
public:
   using Member =
      std::function<Vector3<>(const MaterialPoint &, const Vector &, real_t)>;
   explicit VectorOf(Member member_)
      : VectorCoefficient(3), member(std::move(member_))
   {
   }
   using VectorCoefficient::Eval;
   void Eval(Vector &value, ElementTransformation &trans,
             const IntegrationPoint &ip) override
   {
      const Vector3<> found = member({trans, ip}, Place(trans, ip), GetTime());
      value.SetSize(3);
      for (int i = 0; i < 3; i++)
      {
         value[i] = found[i];
      }
   }

private:
   Member member;
};

class ScalarOf : public Coefficient
{
public:
   using Member =
      std::function<real_t(const MaterialPoint &, const Vector &, real_t)>;
   explicit ScalarOf(Member member_) : member(std::move(member_)) {}
   real_t Eval(ElementTransformation &trans,
               const IntegrationPoint &ip) override
   {
      return member({trans, ip}, Place(trans, ip), GetTime());
   }

private:
   Member member;
};

/// The unit cube in elements that are skewed smoothly.
NamedMesh MakeMesh(Element::Type type, int cells)
{
   Mesh mesh = Mesh::MakeCartesian3D(cells, cells, cells, type);
   for (int i = 0; i < mesh.GetNV(); i++)
   {
      real_t *x = mesh.GetVertex(i);
      const real_t bump =
         8.0 * x[0] * (1.0 - x[0]) * x[1] * (1.0 - x[1]) * x[2] * (1.0 - x[2]);
      x[0] += 0.2 * bump;
      x[1] -= 0.15 * bump;
      x[2] += 0.25 * bump;
   }
   return DistributeMesh(mesh, {{"body", {1}}}, {}, MPI_COMM_WORLD);
}

/// Where displacement is prescribed.
enum class Sides
{
   all,
   four
};

struct Errors
{
   real_t u;
   real_t p;
};

/// Errors in L2 at time 1.
Errors Solve(Element::Type type, int cells, int order, real_t kappa,
             Sides sides)
{
   const Bodies bodies(kappa);
   VectorOf displacement(
      [&](const MaterialPoint &, const Vector &x, real_t t)
      {
         return Vector3<>{t * bodies.waves.U(x, 0), t * bodies.waves.U(x, 1),
                          t * bodies.waves.U(x, 2)};
      });
   ScalarOf pressure([&](const MaterialPoint &, const Vector &x, real_t t)
                     { return t * bodies.waves.P(x); });
   VectorOf force([&](const MaterialPoint &point, const Vector &x, real_t t)
                  { return bodies.Force(point, x, t); });
   ScalarOf source([&](const MaterialPoint &point, const Vector &x, real_t t)
                   { return bodies.Source(point, x, t); });

   NamedMesh mesh = MakeMesh(type, cells);
   SpaceOptions space;
   space.order = order;
   space.deformation = Deformation::finite;
   BiphasicProblem problem(mesh, space);
   problem.SetMaterial("body", bodies.solid, bodies.permeability, 0.2);
   NonlinearOptions nonlinear;
   nonlinear.linear.relative_tolerance = 1e-10;
   problem.SetNonlinearOptions(nonlinear);
   BoundaryConditions &conditions = problem.Conditions();
   conditions.AddBodyForce(force);
   conditions.AddFluidSource(source);
   const bool mixed = sides == Sides::four;
   conditions.PrescribeDisplacement(mixed ? Array<int>({1, 2, 4, 5})
                                          : Array<int>({1, 2, 3, 4, 5, 6}),
                                    displacement);
   conditions.PrescribePressure(Array<int>({1, 3}), pressure);
   // Sides by attribute: z0, y0, x1, y1, x0, z1.
   const int axis[6] = {2, 1, 0, 1, 0, 2};
   const real_t sign[6] = {-1.0, -1.0, 1.0, 1.0, -1.0, 1.0};
   std::vector<std::unique_ptr<VectorCoefficient>> tractions;
   for (const int side : mixed ? Array<int>({3, 6}) : Array<int>())
   {
      tractions.push_back(std::make_unique<VectorOf>(
         [&, d = axis[side - 1], s = sign[side - 1]](const MaterialPoint &point,
                                                     const Vector &x, real_t t)
         {
            const Tensor3<> stress = bodies.Stress(point, x, t);
            return Vector3<>{s * stress[0][d], s * stress[1][d],
                             s * stress[2][d]};
         }));
      conditions.AddTraction(Array<int>({side}), *tractions.back());
   }
   std::vector<std::unique_ptr<Coefficient>> fluxes;
   for (const int side : {2, 4, 5, 6})
   {
      fluxes.push_back(std::make_unique<ScalarOf>(
         [&, d = axis[side - 1], s = sign[side - 1]](const MaterialPoint &point,
                                                     const Vector &x, real_t t)
         { return s * bodies.Flow(point, x, t)[d]; }));
      conditions.AddNormalFlux(Array<int>({side}), *fluxes.back());
   }

   TimeOptions times;
   times.end = 1.0;
   times.step = step;
   times.cut_back = false;
   TimeStepper stepper(problem, times);
   while (!stepper.Done())
   {
      const StepReport report = stepper.Step();
      INFO(report.reason);
      REQUIRE(report.converged);
   }
   const StrainExtremes strains =
      StrainMonitor(mesh, stepper.Displacement(), Deformation::finite)
         .Measure();
   CHECK(std::abs(strains.max_principal.value) > 0.28);
   displacement.SetTime(1.0);
   pressure.SetTime(1.0);
   const IntegrationRule *rules[Geometry::NumGeom];
   for (int g = 0; g < Geometry::NumGeom; g++)
   {
      rules[g] = &IntRules.Get(g, 2 * order + 3);
   }
   return {stepper.Displacement().ComputeL2Error(displacement, rules),
           stepper.Pressure().ComputeL2Error(pressure, rules)};
}

constexpr real_t slack = 0.2;
constexpr real_t drained = 10.0;
constexpr real_t undrained = 1e-6;

/// Convergence in space from @a cells to twice as many cells on an edge.
Errors Rates(Element::Type type, int cells, int order, real_t kappa,
             Sides sides = Sides::four)
{
   const Errors coarse = Solve(type, cells, order, kappa, sides);
   const Errors fine = Solve(type, 2 * cells, order, kappa, sides);
   CAPTURE(coarse.u, fine.u, coarse.p, fine.p);
   CHECK(fine.u < 5e-3);
   CHECK(fine.p < 2e-2);
   return {std::log2(coarse.u / fine.u), std::log2(coarse.p / fine.p)};
}
} // namespace

TEST_CASE("At 30 % strain quadratic displacement converges with orders 3 and 2 "
          "undrained, 2 and 2 drained")
{
   const auto type =
      GENERATE(Element::TETRAHEDRON, Element::HEXAHEDRON, Element::WEDGE);
   CAPTURE(static_cast<int>(type));
   const Errors stokes = Rates(type, 3, 2, undrained, Sides::all);
   CAPTURE(stokes.u, stokes.p);
   CHECK(stokes.u > 3.0 - slack);
   CHECK(stokes.p > 2.0 - slack);
   const Errors poisson_like = Rates(type, 3, 2, drained);
   CAPTURE(poisson_like.u, poisson_like.p);
   CHECK(poisson_like.u > 2.0 - slack);
   CHECK(poisson_like.p > 2.0 - slack);
}

TEST_CASE("At 30 % strain cubic displacement converges with orders 4 and 3")
{
   const auto type = GENERATE(Element::TETRAHEDRON, Element::HEXAHEDRON);
   const real_t kappa = GENERATE(undrained, drained);
   CAPTURE(static_cast<int>(type), kappa);
   const Errors rates = Rates(type, 2, 3, kappa);
   CAPTURE(rates.u, rates.p);
   CHECK(rates.u > 4.0 - slack);
   CHECK(rates.p > 3.0 - slack);
}

TEST_CASE("At 30 % strain stabilized linear displacement converges with orders "
          "2 and 1")
{
   const auto type =
      GENERATE(Element::TETRAHEDRON, Element::HEXAHEDRON, Element::WEDGE);
   const real_t kappa = GENERATE(undrained, drained);
   CAPTURE(static_cast<int>(type), kappa);
   const Errors rates = Rates(type, 4, 1, kappa);
   CAPTURE(rates.u, rates.p);
   CHECK(rates.u > 2.0 - slack);
   CHECK(rates.p > 1.0 - slack);
}
