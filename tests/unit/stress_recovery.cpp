// ranks: 1 2 3

#include "synovia/fem/stress_recovery.hpp"
#include "support/boxes.hpp"
#include "support/two_boxes.hpp"
#include "synovia/materials/permeabilities/constant_permeability.hpp"
#include "synovia/materials/solids/isotropic_elastic.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t young = 2.0;
constexpr real_t poisson = 0.25;
constexpr real_t mu = young / (2.0 * (1.0 + poisson));
constexpr real_t lambda = 2.0 * mu * poisson / (1.0 - 2.0 * poisson);

using VectorFunction = std::function<void(const Vector &, Vector &)>;
using ScalarFunction = std::function<real_t(const Vector &)>;

/// A mesh with displacement and pressure on it, and the stresses of both.
struct Problem
{
   Problem(NamedMesh mesh_, int order)
      : mesh(std::move(mesh_)), solid(young, poisson), permeability(1.0),
        quadratic(order, 3), linear(std::max(1, order - 1), 3),
        displacement(&mesh.Get(), &quadratic, 3, Ordering::byVDIM),
        pressure(&mesh.Get(), &linear), u(&displacement), p(&pressure)
   {
      for (const auto &[name, attributes] : mesh.Regions())
      {
         materials.Set(mesh.Region(name), {&solid, &permeability, 0.2});
      }
      recovery = std::make_unique<StressRecovery>(displacement, materials);
   }

   void Recover(const VectorFunction &exact_u, const ScalarFunction &exact_p)
   {
      VectorFunctionCoefficient u_coefficient(3, exact_u);
      FunctionCoefficient p_coefficient(exact_p);
      u.ProjectCoefficient(u_coefficient);
      p.ProjectCoefficient(p_coefficient);
      recovery->Update(u, p);
   }

   NamedMesh mesh;
   IsotropicElastic solid;
   ConstantPermeability permeability;
   MaterialTable materials;
   H1_FECollection quadratic;
   H1_FECollection linear;
   ParFiniteElementSpace displacement;
   ParFiniteElementSpace pressure;
   ParGridFunction u;
   ParGridFunction p;
   std::unique_ptr<StressRecovery> recovery;
};

/// The largest difference at any node.
real_t Difference(const ParGridFunction &field, const VectorFunction &exact)
{
   ParGridFunction wanted(field.ParFESpace());
   VectorFunctionCoefficient coefficient(field.VectorDim(), exact);
   wanted.ProjectCoefficient(coefficient);
   wanted -= field;
   return wanted.Normlinf();
}

real_t Zero(const Vector &)
{
   return 0.0;
}
} // namespace

TEST_CASE("Stresses of one order below the displacement are exact", "[stress]")
{
   BoxOptions box;
   box.nx = box.ny = 2;
   box.nz = 3;
   box.type =
      GENERATE(Element::HEXAHEDRON, Element::TETRAHEDRON, Element::WEDGE);
   const int order = GENERATE(1, 2, 3);
   Problem problem(MakeBox(box), order);
   const real_t q = order > 1 ? 1.0 : 0.0; // quadratic terms
   const real_t a = 0.3;
   // u = (a x + q x^2 / 2, a z, q x y), so that eps = (a + q x, 0, 0 | 0, a + q
   // x, q y) with engineering shear.
   problem.Recover(
      [=](const Vector &x, Vector &u)
      {
         u(0) = a * x(0) + 0.5 * q * x(0) * x(0);
         u(1) = a * x(2);
         u(2) = q * x(0) * x(1);
      },
      [](const Vector &x) { return 1.0 + x(0) - 2.0 * x(2); });
   const auto effective = [=](const Vector &x, Vector &s)
   {
      const real_t exx = a + q * x(0);
      s(0) = (lambda + 2.0 * mu) * exx;
      s(1) = s(2) = lambda * exx;
      s(3) = 0.0;
      s(4) = mu * (a + q * x(0));
      s(5) = mu * q * x(1);
   };
   CHECK(Difference(problem.recovery->Effective(), effective) < 1e-12);
   const auto total = [=](const Vector &x, Vector &s)
   {
      effective(x, s);
      for (int c = 0; c < 3; c++)
      {
         s(c) -= 1.0 + x(0) - 2.0 * x(2);
      }
   };
   CHECK(Difference(problem.recovery->Total(), total) < 1e-12);
}

TEST_CASE("A node takes the mean of the elements around it", "[stress]")
{
   // u_z = |z - 1/2|: the strain is -1 below and 1 above, and the mean of as
   // many elements on either side is 0, on whichever ranks they are.
   BoxOptions box;
   box.nx = box.ny = 3;
   box.nz = 4;
   Problem problem(MakeBox(box), 2);
   problem.Recover(
      [](const Vector &x, Vector &u)
      {
         u = 0.0;
         u(2) = std::abs(x(2) - 0.5);
      },
      Zero);
   const auto mean = [](const Vector &x, Vector &s)
   {
      const real_t strain = std::abs(x(2) - 0.5) < 1e-9 ? 0.0
                            : x(2) < 0.5                ? -1.0
                                                        : 1.0;
      s = 0.0;
      s(0) = s(1) = lambda * strain;
      s(2) = (lambda + 2.0 * mu) * strain;
   };
   CHECK(Difference(problem.recovery->Effective(), mean) < 1e-12);
}

TEST_CASE("Touching bodies keep their own stresses", "[stress]")
{
   Problem problem(
      MakeTwoBoxes(GENERATE(Element::HEXAHEDRON, Element::TETRAHEDRON)), 2);
   // Projected body by body, since the displacement jumps at z = 1.
   VectorFunctionCoefficient strained(3,
                                      [](const Vector &x, Vector &u)
                                      {
                                         u = 0.0;
                                         u(2) = x(2);
                                      });
   VectorFunctionCoefficient still(3,
                                   [](const Vector &, Vector &u) { u = 0.0; });
   PWVectorCoefficient by_body(3);
   by_body.UpdateCoefficient(1, strained);
   by_body.UpdateCoefficient(2, still);
   problem.u.ProjectCoefficient(by_body);
   problem.p = 0.0;
   problem.recovery->Update(problem.u, problem.p);
   ParGridFunction &stress = problem.recovery->Effective();

   Vector value;
   for (int e = 0; e < problem.mesh.Get().GetNE(); e++)
   {
      const bool lower = problem.mesh.Get().GetAttribute(e) == 1;
      const FiniteElement &element = *problem.displacement.GetFE(e);
      for (int i = 0; i < element.GetDof(); i++)
      {
         stress.GetVectorValue(e, element.GetNodes().IntPoint(i), value);
         CHECK(value(2) ==
               Approx(lower ? lambda + 2.0 * mu : 0.0).margin(1e-12));
      }
   }
}

TEST_CASE("Principal stresses are sorted, largest first", "[stress]")
{
   BoxOptions box;
   box.type = Element::TETRAHEDRON;
   Problem problem(MakeBox(box), 2);
   // Shear tau = mu g in the plane of x and y, and p = 3: tau - 3, -3, -tau
   // - 3.
   const real_t g = 0.5;
   problem.Recover(
      [=](const Vector &x, Vector &u)
      {
         u = 0.0;
         u(0) = g * x(1);
      },
      [](const Vector &) { return 3.0; });
   const auto principal = [=](const Vector &, Vector &s)
   {
      s(0) = mu * g - 3.0;
      s(1) = -3.0;
      s(2) = -mu * g - 3.0;
   };
   CHECK(Difference(problem.recovery->Principal(), principal) < 1e-12);
}
