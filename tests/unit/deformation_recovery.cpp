// ranks: 1 2 3
//
// Fields of finite deformation against closed forms: strains, volume ratio,
// porosity, stresses and their directions.

#include "synovia/fem/deformation_recovery.hpp"
#include "support/boxes.hpp"
#include "synovia/fem/stress_recovery.hpp"
#include "synovia/materials/permeabilities/constant_permeability.hpp"
#include "synovia/materials/solids/neo_hookean.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t young = 2.0;
constexpr real_t poisson = 0.25;
constexpr real_t mu = young / (2.0 * (1.0 + poisson));
constexpr real_t lambda = 2.0 * mu * poisson / (1.0 - 2.0 * poisson);
constexpr real_t solid_fraction = 0.3;

/// A box of one material in finite deformation.
struct Body
{
   Body(Element::Type type, int order)
      : mesh(MakeCells(type)), elements(order, 3), p_elements(1, 3),
        space(&mesh.Get(), &elements, 3, Ordering::byVDIM),
        p_space(&mesh.Get(), &p_elements), u(&space), p(&p_space)
   {
      materials.Set(mesh.Region("body"),
                    {&solid, &permeability, solid_fraction});
   }

   static NamedMesh MakeCells(Element::Type type)
   {
      BoxOptions box;
      box.nx = box.ny = 2;
      box.nz = 3;
      box.type = type;
      return MakeBox(box);
   }

   const NeoHookean solid{young, poisson};
   const ConstantPermeability permeability{1.0};
   NamedMesh mesh;
   H1_FECollection elements;
   H1_FECollection p_elements;
   ParFiniteElementSpace space;
   ParFiniteElementSpace p_space;
   ParGridFunction u;
   ParGridFunction p;
   MaterialTable materials;
};

// The largest difference of any node's components from the same everywhere.
real_t Difference(const ParGridFunction &field, const std::vector<real_t> &same)
{
   const ParFiniteElementSpace &space = *field.ParFESpace();
   REQUIRE(space.GetVDim() == static_cast<int>(same.size()));
   real_t largest = 0.0;
   for (int i = 0; i < space.GetNDofs(); i++)
   {
      for (int c = 0; c < space.GetVDim(); c++)
      {
         largest =
            std::max(largest, std::abs(field[space.DofToVDof(i, c)] - same[c]));
      }
   }
   return largest;
}
} // namespace

TEST_CASE("Strains, volume, porosity and stresses of a turned, stretched body")
{
   const auto type =
      GENERATE(Element::HEXAHEDRON, Element::TETRAHEDRON, Element::WEDGE);
   const int order = GENERATE(1, 2);
   CAPTURE(static_cast<int>(type), order);
   Body body(type, order);
   // Stretches 1.3, 0.6, 0.9 along x, y, z, then turned by 30 degrees about z.
   const std::array<real_t, 3> stretch{{1.3, 0.6, 0.9}};
   const real_t c = std::sqrt(0.75);
   const real_t s = 0.5;
   VectorFunctionCoefficient turned(3,
                                    [&](const Vector &x, Vector &u)
                                    {
                                       const real_t a = stretch[0] * x[0];
                                       const real_t b = stretch[1] * x[1];
                                       u[0] = c * a - s * b - x[0];
                                       u[1] = s * a + c * b - x[1];
                                       u[2] = (stretch[2] - 1.0) * x[2];
                                    });
   body.u.ProjectCoefficient(turned);
   constexpr real_t pressure = 0.7;
   body.p = pressure;
   const real_t J = stretch[0] * stretch[1] * stretch[2];

   DeformationRecovery strains(body.space, body.materials);
   CHECK(Difference(strains.Porosity(), {1.0 - solid_fraction}) < 1e-12);
   strains.Update(body.u);
   CHECK(Difference(strains.PrincipalStrain(),
                    {std::log(1.3), std::log(0.9), std::log(0.6)}) < 1e-12);
   CHECK(Difference(strains.VolumeRatio(), {J}) < 1e-12);
   CHECK(Difference(strains.Porosity(), {1.0 - solid_fraction / J}) < 1e-12);

   StressRecovery stress(body.space, body.materials, Deformation::finite);
   stress.Update(body.u, body.p);
   const auto cauchy = [&](int i) {
      return (mu * (stretch[i] * stretch[i] - 1.0) + lambda * std::log(J)) / J;
   };
   const real_t along = cauchy(0);
   const real_t across = cauchy(1);
   CHECK(Difference(stress.Effective(),
                    {c * c * along + s * s * across,
                     s * s * along + c * c * across, cauchy(2),
                     c * s * (along - across), 0.0, 0.0}) < 1e-12);
   CHECK(Difference(stress.Principal(), {along - pressure, cauchy(2) - pressure,
                                         across - pressure}) < 1e-12);
   ParGridFunction largest(&stress.VectorSpace());
   ParGridFunction smallest(&stress.VectorSpace());
   stress.GetDirections(largest, smallest);
   // A direction may have either sign.
   for (int i = 0; i < stress.VectorSpace().GetNDofs(); i++)
   {
      const auto at = [&](const ParGridFunction &field, int k)
      { return field[stress.VectorSpace().DofToVDof(i, k)]; };
      const real_t by_largest = c * at(largest, 0) + s * at(largest, 1);
      const real_t by_smallest = -s * at(smallest, 0) + c * at(smallest, 1);
      REQUIRE(std::abs(by_largest) == Approx(1.0).epsilon(1e-12));
      REQUIRE(std::abs(by_smallest) == Approx(1.0).epsilon(1e-12));
   }
}

TEST_CASE("A rigid rotation strains nothing and makes no stress")
{
   const int order = GENERATE(1, 2);
   Body body(Element::HEXAHEDRON, order);
   VectorFunctionCoefficient turned(3,
                                    [](const Vector &x, Vector &u)
                                    {
                                       u[0] = -x[1] - x[0];
                                       u[1] = x[0] - x[1];
                                       u[2] = 0.0;
                                    });
   body.u.ProjectCoefficient(turned);
   body.p = 0.0;
   DeformationRecovery strains(body.space, body.materials);
   strains.Update(body.u);
   CHECK(strains.PrincipalStrain().Normlinf() < 1e-14);
   StressRecovery stress(body.space, body.materials, Deformation::finite);
   stress.Update(body.u, body.p);
   CHECK(stress.Total().Normlinf() < 1e-14);
}
