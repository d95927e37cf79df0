// ranks: 1
//
// Stresses and tangents of the laws for finite deformation: against published
// formulas as another program has them, against differences of themselves,
// at small strains, and in a frame that turns.

#include "synovia/materials/deforming_permeability.hpp"
#include "synovia/materials/fiber_laws.hpp"
#include "synovia/materials/holmes_mow.hpp"
#include "synovia/materials/mooney_rivlin.hpp"
#include "synovia/materials/neo_hookean.hpp"
#include "synovia/materials/porous_neo_hookean.hpp"
#include "synovia/materials/saint_venant_kirchhoff.hpp"
#include "synovia/materials/solid_mixture.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
const Tensor3<> deformed{
   {{1.10, 0.20, -0.05}, {0.10, 0.90, 0.15}, {-0.10, 0.05, 1.05}}};
const real_t volume = 1.0025;

// In the order xx, yy, zz, xy, yz, xz.
constexpr int voigt[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}};

using Voigt = std::array<real_t, 6>;

/// A point anywhere, for laws that need one.
class AnyPoint
{
public:
   AnyPoint()
      : mesh(Mesh::MakeCartesian3D(1, 1, 1, Element::HEXAHEDRON)),
        trans(*mesh.GetElementTransformation(0)),
        ip(Geometries.GetCenter(Geometry::CUBE))
   {
      trans.SetIntPoint(&ip);
   }
   MaterialPoint Get() { return {trans, ip}; }

private:
   Mesh mesh;
   ElementTransformation &trans;
   const IntegrationPoint &ip;
};

// sigma = P F^T / J
Voigt Cauchy(const HyperelasticLaw &law, const Tensor3<> &F)
{
   AnyPoint point;
   Tensor3<> P;
   REQUIRE(law.GetStress(point.Get(), F, P, nullptr));
   const real_t J = Determinant(F, Cofactor(F));
   Voigt sigma;
   for (int v = 0; v < 6; v++)
   {
      const int i = voigt[v][0];
      const int j = voigt[v][1];
      sigma[v] =
         (P[i][0] * F[j][0] + P[i][1] * F[j][1] + P[i][2] * F[j][2]) / J;
   }
   return sigma;
}

void CheckStress(const HyperelasticLaw &law, const Voigt &expected)
{
   const Voigt found = Cauchy(law, deformed);
   for (int v = 0; v < 6; v++)
   {
      CAPTURE(v);
      CHECK(found[v] == Approx(expected[v]).epsilon(1e-10));
   }
}

// Of the function that sets a tensor, by F.
template <typename Function>
void CheckDerivative(const Function &function, const Tensor3<> &F)
{
   constexpr real_t step = 1e-6;
   Tensor3<> value;
   Tangent3 tangent;
   REQUIRE(function(F, value, &tangent));
   real_t largest = 0.0;
   for (int k = 0; k < 9; k++)
   {
      for (int l = 0; l < 9; l++)
      {
         largest = std::max(largest, std::abs(tangent[k][l]));
      }
   }
   REQUIRE(largest > 0.0);
   for (int l = 0; l < 9; l++)
   {
      Tensor3<> ahead = F;
      Tensor3<> behind = F;
      ahead[l / 3][l % 3] += step;
      behind[l / 3][l % 3] -= step;
      Tensor3<> ahead_value;
      Tensor3<> behind_value;
      REQUIRE(function(ahead, ahead_value, nullptr));
      REQUIRE(function(behind, behind_value, nullptr));
      for (int k = 0; k < 9; k++)
      {
         CAPTURE(k, l);
         const real_t difference =
            (ahead_value[k / 3][k % 3] - behind_value[k / 3][k % 3]) /
            (2.0 * step);
         CHECK(std::abs(tangent[k][l] - difference) < 2e-9 * largest);
      }
   }
}

struct Laws
{
   const CartesianFrame frame{{{std::cos(0.3) * std::cos(0.2),
                                std::sin(0.3) * std::cos(0.2), std::sin(0.2)}}};
   const NeoHookean neo_hookean{1.0, 0.3};
   const HolmesMow holmes_mow{1.0, 0.2, 0.35};
   const MooneyRivlin mooney_rivlin{0.3, 0.2, 1.5};
   const PorousNeoHookean porous{0.5, 0.2};
   const SaintVenantKirchhoff linear{1.0, 0.3};
   const ExponentialPowerFiber exponential{5.0, 1.0, 2.5, frame};
   const ExponentialPowerFiber power{5.0, 0.0, 2.5, frame};
   const NeoHookeanFiber fiber{2.0, frame};
   const PowerLinearFiber toe{10.0, 1.2, 3.0, frame};
   const PowerLinearFiber straight{10.0, 1.02, 3.0, frame};
   const SolidMixture mixture{{&holmes_mow, &exponential}};

   std::vector<const HyperelasticLaw *> All() const
   {
      return {&neo_hookean, &holmes_mow,  &mooney_rivlin, &porous,
              &linear,      &exponential, &power,         &fiber,
              &toe,         &straight,    &mixture};
   }
};
} // namespace

TEST_CASE("Stresses are those of an independent program")
{
   const Laws laws;
   CheckStress(laws.neo_hookean, {{0.09831011712943849, -0.05898894291276371,
                                   0.04555738357869997, 0.10838288893151736,
                                   0.07385382697103396, -0.05850757721081911}});
   CheckStress(laws.holmes_mow, {{0.1252081088764957, -0.06412798671154983,
                                  0.07415523190713133, 0.13336813600247235,
                                  0.09814582165562197, -0.07155194309138452}});
   CheckStress(laws.porous, {{0.05937845533279113, -0.0306339992457225,
                              0.02919135166316779, 0.062020776630317354,
                              0.0422619451374729, -0.03348024225176424}});
}

TEST_CASE("Tangents are the derivatives of stresses")
{
   const Laws laws;
   AnyPoint point;
   int index = 0;
   for (const HyperelasticLaw *law : laws.All())
   {
      CAPTURE(index++);
      CheckDerivative([&](const Tensor3<> &F, Tensor3<> &P, Tangent3 *tangent)
                      { return law->GetStress(point.Get(), F, P, tangent); },
                      deformed);
   }
}

TEST_CASE("Small strains have the moduli that a law names")
{
   const Laws laws;
   AnyPoint point;
   for (const HyperelasticLaw *law :
        {static_cast<const HyperelasticLaw *>(&laws.neo_hookean),
         static_cast<const HyperelasticLaw *>(&laws.holmes_mow),
         static_cast<const HyperelasticLaw *>(&laws.mooney_rivlin),
         static_cast<const HyperelasticLaw *>(&laws.porous),
         static_cast<const HyperelasticLaw *>(&laws.linear)})
   {
      DenseMatrix stiffness;
      law->GetStiffness(point.Get().trans, point.Get().ip, stiffness);
      const real_t H = law->AggregateModulus();
      const real_t mu = law->ShearModulus();
      for (int i = 0; i < 6; i++)
      {
         for (int j = 0; j < 6; j++)
         {
            CAPTURE(i, j);
            const real_t expected = i != j
                                       ? (i < 3 && j < 3 ? H - 2.0 * mu : 0.0)
                                    : i < 3 ? H
                                            : mu;
            CHECK(stiffness(i, j) ==
                  Approx(expected).epsilon(1e-12).margin(1e-12 * H));
         }
      }
      const Voigt rest = Cauchy(*law, IdentityTensor());
      for (int v = 0; v < 6; v++)
      {
         CHECK(std::abs(rest[v]) < 1e-14 * H);
      }
   }
}

TEST_CASE("Stresses turn with the body")
{
   const Laws laws;
   AnyPoint point;
   const real_t c = std::cos(0.7);
   const real_t s = std::sin(0.7);
   const Tensor3<> about_z{{{c, -s, 0.0}, {s, c, 0.0}, {0.0, 0.0, 1.0}}};
   const Tensor3<> about_x{{{1.0, 0.0, 0.0}, {0.0, c, -s}, {0.0, s, c}}};
   const Tensor3<> Q = Product(about_z, about_x);
   for (const HyperelasticLaw *law : laws.All())
   {
      Tensor3<> stress;
      Tensor3<> turned;
      REQUIRE(law->GetStress(point.Get(), deformed, stress, nullptr));
      REQUIRE(
         law->GetStress(point.Get(), Product(Q, deformed), turned, nullptr));
      const Tensor3<> expected = Product(Q, stress);
      for (int k = 0; k < 9; k++)
      {
         CHECK(std::abs(turned[k / 3][k % 3] - expected[k / 3][k % 3]) <
               1e-12 * (1.0 + std::abs(expected[k / 3][k % 3])));
      }
   }
}

TEST_CASE("Fibers resist no compression")
{
   const Laws laws;
   const CartesianFrame along_x(Point3{{1.0, 0.0, 0.0}});
   const NeoHookeanFiber fiber(2.0, along_x);
   const Tensor3<> shorter{{{0.9, 0.0, 0.0}, {0.0, 1.1, 0.0}, {0.0, 0.0, 1.1}}};
   const Tensor3<> longer{{{1.1, 0.0, 0.0}, {0.0, 0.9, 0.0}, {0.0, 0.0, 0.9}}};
   CHECK(Cauchy(fiber, shorter)[0] == 0.0);
   // s = mu (I_n - 1)/J N
   CHECK(Cauchy(fiber, longer)[0] ==
         Approx(2.0 * (1.21 - 1.0) / (1.1 * 0.81) * 1.21));
}

TEST_CASE("Referential permeabilities and their derivatives")
{
   AnyPoint point;
   const SpatialPermeability constant(4.0e-3);
   const HolmesMowPermeability holmes_mow(4.0e-3, 2.0, 2.0, 0.2);
   for (const DeformingPermeability *law :
        {static_cast<const DeformingPermeability *>(&constant),
         static_cast<const DeformingPermeability *>(&holmes_mow)})
   {
      CheckDerivative(
         [&](const Tensor3<> &F, Tensor3<> &K, Tangent3 *tangent)
         { return law->GetReferential(point.Get(), F, K, tangent); },
         deformed);
      // k = F K F^T / J
      Tensor3<> K;
      REQUIRE(law->GetReferential(point.Get(), deformed, K, nullptr));
      const real_t spatial = law == &constant
                                ? 4.0e-3
                                : 4.0e-3 * std::pow((volume - 0.2) / 0.8, 2.0) *
                                     std::exp(volume * volume - 1.0);
      const Tensor3<> FK = Product(deformed, K);
      for (int i = 0; i < 3; i++)
      {
         for (int j = 0; j < 3; j++)
         {
            real_t k = 0.0;
            for (int m = 0; m < 3; m++)
            {
               k += FK[i][m] * deformed[j][m] / volume;
            }
            CHECK(k ==
                  Approx(i == j ? spatial : 0.0).epsilon(1e-12).margin(1e-14));
         }
      }
   }
   Tensor3<> closed = IdentityTensor();
   closed[2][2] = 0.19;
   Tensor3<> K;
   CHECK_FALSE(holmes_mow.GetReferential(point.Get(), closed, K, nullptr));
}

TEST_CASE("Laws refuse what they can't be")
{
   const CartesianFrame frame(Point3{{1.0, 0.0, 0.0}});
   const NeoHookeanFiber fiber(1.0, frame);
   CHECK_THROWS_WITH(NeoHookean(0.0, 0.3),
                     Catch::Contains("Young's modulus is 0"));
   CHECK_THROWS_WITH(NeoHookean(1.0, 0.5),
                     Catch::Contains("Poisson's ratio is 0.5"));
   CHECK_THROWS_WITH(HolmesMow(1.0, 0.3, -1.0),
                     Catch::Contains("beta of a Holmes-Mow solid is -1"));
   CHECK_THROWS_WITH(MooneyRivlin(0.0, 0.0, 1.0), Catch::Contains("c1, c2"));
   CHECK_THROWS_WITH(PorousNeoHookean(1.0, 1.0),
                     Catch::Contains("solid fraction is 1"));
   CHECK_THROWS_WITH(ExponentialPowerFiber(1.0, 0.0, 1.5, frame),
                     Catch::Contains("beta of a fiber is 1.5"));
   CHECK_THROWS_WITH(SolidMixture({&fiber}),
                     Catch::Contains("add a ground matrix"));
   CHECK_THROWS_WITH(HolmesMowPermeability(1.0, -1.0, 2.0, 0.2),
                     Catch::Contains("M of a permeability is -1"));
}
