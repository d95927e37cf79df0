// ranks: 1
//
// The permeability laws that are registered: tensors in space against their
// formulas, derivatives against differences, a body that turns, closed pores.

#include "support/deformed_point.hpp"
#include "support/reference_table.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <set>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t solid_fraction = 0.2;

/// A law with values for its parameters, and its tensor in space.
struct Sample
{
   std::string name;
   std::map<std::string, real_t> values;
   std::function<Tensor3<>(const Tensor3<> &F, real_t J)> spatial;
};

real_t Growth(real_t J, real_t m, real_t alpha)
{
   return std::pow((J - solid_fraction) / (1.0 - solid_fraction), alpha) *
          std::exp(0.5 * m * (J * J - 1.0));
}

Tensor3<> Transposed(const Tensor3<> &A)
{
   return TransposedProduct(A, IdentityTensor());
}

Tensor3<> LeftCauchyGreen(const Tensor3<> &F)
{
   return Product(F, Transposed(F));
}

Tensor3<> TransverselyIsotropicSpatial(const Tensor3<> &F, real_t J)
{
   const real_t a_t = 0.4 / (J * J) * Growth(J, 1.0, 0.5);
   const real_t a_a = 0.7 / (J * J) * Growth(J, 1.5, 1.0);
   const real_t c_t = 0.2 / (2.0 * std::pow(J, 4.0)) * Growth(J, 1.0, 0.5);
   const real_t c_a = 0.3 / (2.0 * std::pow(J, 4.0)) * Growth(J, 1.5, 1.0);
   const Tensor3<> b = LeftCauchyGreen(F);
   const Vector3<> v = Product(F, SomeDirection());
   Tensor3<> m{};
   AddOuterProduct(1.0, v, v, m);
   return (1.1 * Growth(J, 2.0, 1.5)) * IdentityTensor() + a_t * b +
          (a_a - a_t) * m + (2.0 * c_t) * Product(b, b) +
          (c_a - c_t) * (Product(m, b) + Product(b, m));
}

Tensor3<> OrthotropicSpatial(const Tensor3<> &F, real_t J)
{
   const real_t first[3] = {0.5, 0.7, 0.3};
   const real_t second[3] = {0.1, 0.4, 0.2};
   const real_t m[3] = {1.0, 1.5, 2.0};
   const real_t alpha[3] = {0.5, 1.0, 2.5};
   const Tensor3<> axes =
      AxesAlong({SomeDirection()[0], SomeDirection()[1], SomeDirection()[2]});
   const Tensor3<> b = LeftCauchyGreen(F);
   Tensor3<> k = (1.1 * Growth(J, 2.0, 1.5)) * IdentityTensor();
   for (int a = 0; a < 3; a++)
   {
      const Vector3<> v =
         Product(F, Vector3<>{axes[0][a], axes[1][a], axes[2][a]});
      Tensor3<> texture{};
      AddOuterProduct(1.0, v, v, texture);
      const real_t f = Growth(J, m[a], alpha[a]);
      k = k + (first[a] * f / (J * J)) * texture +
          (second[a] * f / (2.0 * std::pow(J, 4.0))) *
             (Product(texture, b) + Product(b, texture));
   }
   return k;
}

std::vector<Sample> Samples()
{
   const std::map<std::string, real_t> isotropic{
      {"k0", 1.0}, {"k1", 0.5}, {"k2", 0.3}, {"M", 2.0}, {"alpha", 1.5}};
   return {
      {"constant",
       {{"value", 4e-3}},
       [](const Tensor3<> &, real_t) { return 4e-3 * IdentityTensor(); }},
      {"exponential",
       {{"value", 4e-3}, {"M", 1.7}},
       [](const Tensor3<> &, real_t J)
       {
          return (4e-3 * std::exp(1.7 * (J - 1.0) / (J - solid_fraction))) *
                 IdentityTensor();
       }},
      {"holmes_mow",
       {{"value", 4e-3}, {"M", 2.0}, {"alpha", 1.9}},
       [](const Tensor3<> &, real_t J)
       { return (4e-3 * Growth(J, 2.0, 1.9)) * IdentityTensor(); }},
      {"referential_isotropic", isotropic,
       [](const Tensor3<> &F, real_t J)
       {
          const Tensor3<> b = LeftCauchyGreen(F);
          return Growth(J, 2.0, 1.5) *
                 (IdentityTensor() + (0.5 / (J * J)) * b +
                  (0.3 / std::pow(J, 4.0)) * Product(b, b));
       }},
      {"referential_transversely_isotropic",
       {{"k0", 1.1},
        {"k1T", 0.4},
        {"k1A", 0.7},
        {"k2T", 0.2},
        {"k2A", 0.3},
        {"M0", 2.0},
        {"MT", 1.0},
        {"MA", 1.5},
        {"alpha0", 1.5},
        {"alphaT", 0.5},
        {"alphaA", 1.0}},
       TransverselyIsotropicSpatial},
      {"referential_orthotropic",
       {{"k0", 1.1},
        {"M0", 2.0},
        {"alpha0", 1.5},
        {"k1_r", 0.5},
        {"k1_theta", 0.7},
        {"k1_z", 0.3},
        {"k2_r", 0.1},
        {"k2_theta", 0.4},
        {"k2_z", 0.2},
        {"M_r", 1.0},
        {"M_theta", 1.5},
        {"M_z", 2.0},
        {"alpha_r", 0.5},
        {"alpha_theta", 1.0},
        {"alpha_z", 2.5}},
       OrthotropicSpatial},
   };
}

/// A registered law.
class Made
{
public:
   explicit Made(const Sample &sample)
      : law(PermeabilityLaws().Make(sample.name,
                                    {sample.values, frame, solid_fraction, {}}))
   {
   }
   const PermeabilityLaw *operator->() const { return law.get(); }

private:
   CartesianFrame frame{
      {{SomeDirection()[0], SomeDirection()[1], SomeDirection()[2]}}};
   std::unique_ptr<PermeabilityLaw> law;
};

Tensor3<> Referential(const Made &law, const Tensor3<> &F)
{
   AnyPoint point;
   Tensor3<> K;
   REQUIRE(law->GetReferential(point.Get(), F, K, nullptr));
   return K;
}

// F K F^T / J
Tensor3<> Spatial(const Made &law, const Tensor3<> &F)
{
   return PushedForward(Product(F, Referential(law, F)), F);
}
} // namespace

TEST_CASE("Each law has its formula in this test", "[laws]")
{
   std::set<std::string> sampled;
   for (const Sample &sample : Samples())
   {
      sampled.insert(sample.name);
   }
   const std::vector<std::string> names =
      PermeabilityLaws().Names(Deformation::finite);
   CHECK(std::set<std::string>(names.begin(), names.end()) == sampled);
}

TEST_CASE("Permeabilities in space follow their formulas", "[laws]")
{
   const Tensor3<> F = SomeDeformation();
   for (const Sample &sample : Samples())
   {
      CAPTURE(sample.name);
      const Made law(sample);
      CHECK(AreClose(sample.spatial(F, Determinant(F, Cofactor(F))),
                     Spatial(law, F), 1e-12));
      // Half as much room as before
      Tensor3<> pressed = F;
      pressed[2][2] *= 0.5;
      CHECK(AreClose(
         sample.spatial(pressed, Determinant(pressed, Cofactor(pressed))),
         Spatial(law, pressed), 1e-12));
   }
}

TEST_CASE("The referential isotropic one is that of another program", "[laws]")
{
   const ReferenceTable table("law_oracles.csv");
   const char *const columns[6] = {"xx", "yy", "zz", "xy", "yz", "xz"};
   for (const Sample &sample : Samples())
   {
      if (sample.name != "referential_isotropic")
      {
         continue;
      }
      const Tensor3<> k = Spatial(Made(sample), SomeDeformation());
      for (int v = 0; v < 6; v++)
      {
         CAPTURE(v);
         CHECK(k[voigt_pairs[v][0]][voigt_pairs[v][1]] ==
               Approx(table.Find({{"law", 5.0}, {"row", 0.0}}, columns[v]))
                  .epsilon(1e-10));
      }
   }
}

TEST_CASE("Derivatives of permeabilities", "[laws]")
{
   for (const Sample &sample : Samples())
   {
      CAPTURE(sample.name);
      const Made law(sample);
      AnyPoint point;
      CheckDerivative(
         [&](const Tensor3<> &F, Tensor3<> &K, Tangent3 *tangent)
         { return law->GetReferential(point.Get(), F, K, tangent); },
         SomeDeformation());
   }
}

TEST_CASE("A body that turns keeps its referential permeability", "[laws]")
{
   for (const Sample &sample : Samples())
   {
      CAPTURE(sample.name);
      const Made law(sample);
      const Tensor3<> F = SomeDeformation();
      CHECK(AreClose(Referential(law, F),
                     Referential(law, Product(SomeRotation(), F)), 1e-12));
   }
}

TEST_CASE("The permeability of the undeformed body", "[laws]")
{
   for (const Sample &sample : Samples())
   {
      CAPTURE(sample.name);
      const Made law(sample);
      const Tensor3<> K = Referential(law, IdentityTensor());
      CHECK(law->ReferenceValue() == Approx(Trace(K) / 3.0));
      AnyPoint point;
      CHECK(law->GetPermeability(point.Get().trans, point.Get().ip) ==
            Approx(K[0][0]));
   }
}

TEST_CASE("Closed pores have no permeability", "[laws]")
{
   AnyPoint point;
   Tensor3<> closed = IdentityTensor();
   closed[2][2] = 0.19;
   for (const Sample &sample : Samples())
   {
      CAPTURE(sample.name);
      Tensor3<> K;
      CHECK(Made(sample)->GetReferential(point.Get(), closed, K, nullptr) ==
            (sample.name == "constant"));
   }
}

TEST_CASE("Permeabilities refuse what they can't be", "[laws]")
{
   const CartesianFrame frame(Point3{{1.0, 0.0, 0.0}});
   CHECK_THROWS_WITH(HolmesMowPermeability(1.0, -1.0, 2.0, 0.2),
                     "the coefficient M is -1; it must be at least 0");
   CHECK_THROWS_WITH(ExponentialPermeability(1.0, 1.0, 0.0),
                     Catch::Contains("solid fraction is 0"));
   CHECK_THROWS_WITH(
      ReferentialIsotropicPermeability(0.0, 0.0, 0.0, {1.0, 1.0, 0.2}),
      "the permeability is 0; it must be positive");
   const PoreGrowth growth{1.0, 1.0, 0.2};
   CHECK_THROWS_WITH(
      ReferentialTransverselyIsotropicPermeability(
         {0.0, 0.0, 1.0, 0.0, 0.0}, growth, growth, growth, frame),
      "the permeability is 0; it must be positive");
   CHECK_THROWS_WITH(
      ReferentialOrthotropicPermeability(
         0.0, growth,
         {{{1.0, 0.0, growth}, {0.0, 1.0, growth}, {0.0, 0.0, growth}}}, frame),
      "the permeability is 0; it must be positive");
}
