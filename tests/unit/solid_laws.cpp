// ranks: 1
//
// The solid laws that are registered: stresses and tangents against those of
// another program, stresses against complex-step derivatives of the energies,
// which are written down here once more, tangents against differences of
// stresses, small strains, and a body that turns.

#include "support/deformed_point.hpp"
#include "support/reference_table.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <complex>
#include <functional>
#include <set>

using namespace mfem;
using namespace synovia;

namespace
{
using Complex = std::complex<real_t>;
using Complex3 = std::array<std::array<Complex, 3>, 3>;

constexpr real_t solid_fraction = 0.2;

/// What energies depend on.
struct Invariants
{
   Complex I1;
   Complex I2;
   Complex J;
   /// n . C n and n . C^2 n for the fibers' direction n.
   Complex In;
   Complex In2;
};

Invariants InvariantsOf(const Complex3 &F)
{
   Complex3 C{};
   Complex trace_of_square = 0.0;
   for (int i = 0; i < 3; i++)
   {
      for (int j = 0; j < 3; j++)
      {
         C[i][j] = F[0][i] * F[0][j] + F[1][i] * F[1][j] + F[2][i] * F[2][j];
         trace_of_square += C[i][j] * C[i][j];
      }
   }
   Invariants all;
   all.I1 = C[0][0] + C[1][1] + C[2][2];
   all.I2 = 0.5 * (all.I1 * all.I1 - trace_of_square);
   all.J = F[0][0] * (F[1][1] * F[2][2] - F[1][2] * F[2][1]) -
           F[0][1] * (F[1][0] * F[2][2] - F[1][2] * F[2][0]) +
           F[0][2] * (F[1][0] * F[2][1] - F[1][1] * F[2][0]);
   const Vector3<> n = SomeDirection();
   all.In = 0.0;
   all.In2 = 0.0;
   for (int i = 0; i < 3; i++)
   {
      const Complex Cn = C[i][0] * n[0] + C[i][1] * n[1] + C[i][2] * n[2];
      all.In += n[i] * Cn;
      all.In2 += Cn * Cn;
   }
   return all;
}

/// A law with values for its parameters, and its energy.
struct Sample
{
   std::string name;
   std::map<std::string, real_t> values;
   std::function<Complex(const Invariants &)> energy;
};

Complex NeoHookeanEnergy(const Invariants &of, real_t mu, real_t lambda)
{
   const Complex log_J = std::log(of.J);
   return mu * (0.5 * (of.I1 - 3.0) - log_J) + 0.5 * lambda * log_J * log_J;
}

Complex HolmesMowEnergy(const Invariants &of, real_t mu, real_t lambda,
                        real_t beta)
{
   const real_t H = lambda + 2.0 * mu;
   const Complex Q =
      beta / H * ((2.0 * mu - lambda) * (of.I1 - 3.0) + lambda * (of.I2 - 3.0));
   return H / (4.0 * beta) * (std::exp(Q) / std::pow(of.J, 2.0 * beta) - 1.0);
}

// A toe up to the stretch lam0, and beyond it linear.
Complex PowLinearEnergy(const Invariants &of, real_t young, real_t straight,
                        real_t beta)
{
   const real_t I0 = straight * straight;
   const real_t xi = young / (4.0 * (beta - 1.0)) * std::pow(I0, -1.5) *
                     std::pow(I0 - 1.0, 2.0 - beta);
   if (of.In.real() < I0)
   {
      return xi / beta * std::pow(of.In - 1.0, beta);
   }
   const real_t b =
      xi * std::pow(I0 - 1.0, beta - 1.0) + young / (2.0 * straight);
   return b * (of.In - I0) - young * (std::sqrt(of.In) - straight) +
          xi / beta * std::pow(I0 - 1.0, beta);
}

// Minus the integral of the osmotic pressure over J.
Complex DonnanEnergy(const Invariants &of, real_t porosity, real_t charge,
                     real_t bath, real_t factor)
{
   const real_t charges = porosity * charge;
   const Complex fluid = of.J - 1.0 + porosity;
   const Complex ions =
      std::sqrt(charges * charges + bath * bath * fluid * fluid);
   return -factor * (ions - charges * std::asinh(charges / (bath * fluid)) -
                     bath * fluid);
}

std::vector<Sample> Samples()
{
   const LameModuli soft(1.0, 0.3);
   const LameModuli cartilage(1.0, 0.2);
   return {
      {"neo_hookean",
       {{"E", 1.0}, {"nu", 0.3}},
       [=](const Invariants &of)
       { return NeoHookeanEnergy(of, soft.mu, soft.lambda); }},
      {"holmes_mow",
       {{"E", 1.0}, {"nu", 0.2}, {"beta", 0.35}},
       [=](const Invariants &of)
       { return HolmesMowEnergy(of, cartilage.mu, cartilage.lambda, 0.35); }},
      {"mooney_rivlin",
       {{"c1", 0.3}, {"c2", 0.2}, {"k", 1.5}},
       [](const Invariants &of)
       {
          const Complex log_J = std::log(of.J);
          return 0.3 * (of.I1 - 3.0) + 0.2 * (of.I2 - 3.0) -
                 2.0 * (0.3 + 2.0 * 0.2) * log_J + 0.75 * log_J * log_J;
       }},
      {"porous_neo_hookean",
       {{"E", 0.5}},
       [](const Invariants &of)
       {
          const real_t pores = 1.0 - solid_fraction;
          const real_t mu = 0.5 / 3.0 * (1.0 + 0.5 * pores * pores);
          const Complex Jb = (of.J - solid_fraction) / pores;
          return 0.5 * mu * (of.I1 * std::pow(Jb / of.J, 2.0 / 3.0) - 3.0) -
                 mu * std::log(Jb);
       }},
      {"saint_venant_kirchhoff",
       {{"E", 1.0}, {"nu", 0.3}},
       [=](const Invariants &of)
       {
          const Complex trace = 0.5 * (of.I1 - 3.0);
          const Complex trace_of_square =
             0.25 * (of.I1 * of.I1 - 2.0 * of.I2 - 2.0 * of.I1 + 3.0);
          return 0.5 * soft.lambda * trace * trace + soft.mu * trace_of_square;
       }},
      {"donnan",
       {{"phiw0", 0.8},
        {"cF0", 150.0},
        {"bosm", 300.0},
        {"Phi", 0.9},
        {"R", 8.314e-6},
        {"T", 310.0}},
       [](const Invariants &of)
       { return DonnanEnergy(of, 0.8, 150.0, 300.0, 0.9 * 8.314e-6 * 310.0); }},
      {"fiber_exp_pow",
       {{"alpha", 1.0}, {"beta", 2.0}, {"ksi", 5.0}, {"mu", 0.2}},
       [](const Invariants &of)
       {
          const Complex excess = of.In - 1.0;
          return 2.5 * (std::exp(excess * excess) - 1.0) +
                 0.05 * (of.In2 - 2.0 * excess - 1.0);
       }},
      {"fiber_exp_pow",
       {{"alpha", 0.0}, {"beta", 2.5}, {"ksi", 5.0}, {"lam0", 1.1}},
       [](const Invariants &of)
       { return 5.0 / 2.5 * std::pow(of.In - 1.1 * 1.1, 2.5); }},
      {"fiber_pow",
       {{"ksi", 5.0}, {"beta", 2.5}},
       [](const Invariants &of) { return 5.0 * std::pow(of.In - 1.0, 2.5); }},
      {"fiber_pow_linear",
       {{"E", 10.0}, {"lam0", 1.2}, {"beta", 3.0}},
       [](const Invariants &of)
       { return PowLinearEnergy(of, 10.0, 1.2, 3.0); }},
      {"fiber_pow_linear",
       {{"E", 10.0}, {"lam0", 1.02}, {"beta", 3.0}},
       [](const Invariants &of)
       { return PowLinearEnergy(of, 10.0, 1.02, 3.0); }},
      {"fiber_nh",
       {{"mu", 2.0}},
       [](const Invariants &of)
       { return 0.5 * (of.In - 1.0) * (of.In - 1.0); }},
      {"fiber_natural_nh",
       {{"ksi", 3.0}, {"lam0", 1.05}},
       [](const Invariants &of)
       {
          const Complex strain = std::log(std::sqrt(of.In) / 1.05);
          return 1.5 * strain * strain;
       }},
   };
}

/// A registered law.
class Made
{
public:
   Made(const std::string &name, const std::map<std::string, real_t> &values,
        const std::vector<const SolidLaw *> &parts = {})
      : law(SolidLaws().Make(name, {values, frame, solid_fraction, parts}))
   {
   }
   const SolidLaw &operator*() const { return *law; }
   const SolidLaw *operator->() const { return law.get(); }

private:
   CartesianFrame frame{
      {{SomeDirection()[0], SomeDirection()[1], SomeDirection()[2]}}};
   std::unique_ptr<SolidLaw> law;
};

Tensor3<> StressOf(const SolidLaw &law, const Tensor3<> &F,
                   Tangent3 *tangent = nullptr)
{
   AnyPoint point;
   Tensor3<> P;
   REQUIRE(law.GetStress(point.Get(), F, P, tangent));
   return P;
}

// The derivative of the energy by the deformation gradient.
Tensor3<> Derivative(const std::function<Complex(const Invariants &)> &energy,
                     const Tensor3<> &F)
{
   constexpr real_t step = 1e-30;
   Tensor3<> derivative;
   for (int k = 0; k < 9; k++)
   {
      Complex3 disturbed;
      for (int l = 0; l < 9; l++)
      {
         disturbed[l / 3][l % 3] = {F[l / 3][l % 3], l == k ? step : 0.0};
      }
      derivative[k / 3][k % 3] = energy(InvariantsOf(disturbed)).imag() / step;
   }
   return derivative;
}

// J^-1 F F F F : 4 d^2 Psi/dC dC, from dP/dF.
real_t SpatialTangent(const Tensor3<> &F, const Tensor3<> &cauchy,
                      const Tangent3 &tangent, const int (&ij)[2],
                      const int (&kl)[2])
{
   const real_t J = Determinant(F, Cofactor(F));
   real_t sum = 0.0;
   for (int b = 0; b < 3; b++)
   {
      for (int d = 0; d < 3; d++)
      {
         sum += F[ij[1]][b] * F[kl[1]][d] *
                tangent[3 * ij[0] + b][3 * kl[0] + d] / J;
      }
   }
   return sum - (ij[0] == kl[0] ? cauchy[ij[1]][kl[1]] : 0.0);
}

void CheckOracle(int number, const SolidLaw &law)
{
   const ReferenceTable table("law_oracles.csv");
   const char *const columns[6] = {"xx", "yy", "zz", "xy", "yz", "xz"};
   const auto expected = [&](int row, int column)
   {
      return table.Find({{"law", real_t(number)}, {"row", real_t(row)}},
                        columns[column]);
   };
   const Tensor3<> F = SomeDeformation();
   Tangent3 tangent;
   const Tensor3<> cauchy = PushedForward(StressOf(law, F, &tangent), F);
   real_t largest = 0.0;
   for (int v = 0; v < 6; v++)
   {
      CAPTURE(v);
      CHECK(cauchy[voigt_pairs[v][0]][voigt_pairs[v][1]] ==
            Approx(expected(0, v)).epsilon(1e-10));
      for (int w = 0; w < 6; w++)
      {
         largest = std::max(largest, std::abs(expected(1 + v, w)));
      }
   }
   for (int v = 0; v < 6; v++)
   {
      for (int w = 0; w < 6; w++)
      {
         CAPTURE(v, w);
         const real_t found =
            SpatialTangent(F, cauchy, tangent, voigt_pairs[v], voigt_pairs[w]);
         CHECK(std::abs(found - expected(1 + v, w)) < 1e-10 * largest);
      }
   }
}
} // namespace

TEST_CASE("Stresses and tangents are those of another program", "[laws]")
{
   CheckOracle(0, *Made("neo_hookean", {{"E", 1.0}, {"nu", 0.3}}));
   CheckOracle(1,
               *Made("holmes_mow", {{"E", 1.0}, {"nu", 0.2}, {"beta", 0.35}}));
   CheckOracle(2, *Made("porous_neo_hookean", {{"E", 0.5}}));
   CheckOracle(
      3, *Made("fiber_exp_pow",
               {{"alpha", 1.0}, {"beta", 2.0}, {"ksi", 5.0}, {"mu", 0.2}}));
   CheckOracle(
      4, *Made("fiber_exp_pow", {{"alpha", 0.0}, {"beta", 2.5}, {"ksi", 5.0}}));
}

TEST_CASE("Each law has its energy in this test", "[laws]")
{
   std::set<std::string> sampled;
   for (const Sample &sample : Samples())
   {
      sampled.insert(sample.name);
   }
   sampled.insert("mixture");
   // In fiber_distributions.cpp
   sampled.insert("continuous_fiber_distribution");
   sampled.insert("ellipsoidal_fiber_distribution");
   const std::vector<std::string> names =
      SolidLaws().Names(Deformation::finite);
   CHECK(std::set<std::string>(names.begin(), names.end()) == sampled);
}

TEST_CASE("Stresses are the derivatives of energies", "[laws]")
{
   for (const Sample &sample : Samples())
   {
      CAPTURE(sample.name);
      const Made law(sample.name, sample.values);
      const Tensor3<> F = SomeDeformation();
      CHECK(AreClose(Derivative(sample.energy, F), StressOf(*law, F), 1e-12));
   }
}

TEST_CASE("Tangents are the derivatives of stresses", "[laws]")
{
   for (const Sample &sample : Samples())
   {
      CAPTURE(sample.name);
      const Made law(sample.name, sample.values);
      AnyPoint point;
      CheckDerivative([&](const Tensor3<> &F, Tensor3<> &P, Tangent3 *tangent)
                      { return law->GetStress(point.Get(), F, P, tangent); },
                      SomeDeformation());
   }
}

TEST_CASE("Stresses turn with the body", "[laws]")
{
   for (const Sample &sample : Samples())
   {
      CAPTURE(sample.name);
      const Made law(sample.name, sample.values);
      CHECK(law->IsObjective());
      const Tensor3<> F = SomeDeformation();
      const Tensor3<> Q = SomeRotation();
      CHECK(AreClose(Product(Q, StressOf(*law, F)),
                     StressOf(*law, Product(Q, F)), 1e-12));
   }
}

TEST_CASE("Small strains have the moduli that a law names", "[laws]")
{
   int isotropic = 0;
   for (const Sample &sample : Samples())
   {
      CAPTURE(sample.name);
      const Made law(sample.name, sample.values);
      if (law->AggregateModulus() == 0.0 || sample.name == "donnan")
      {
         continue; // fibers, and what is under pressure undeformed
      }
      AnyPoint point;
      DenseMatrix stiffness;
      law->GetStiffness(point.Get().trans, point.Get().ip, stiffness);
      const real_t H = law->AggregateModulus();
      const real_t mu = law->ShearModulus();
      isotropic += H > 0.0;
      for (int i = 0; i < 6; i++)
      {
         for (int j = 0; j < 6; j++)
         {
            CAPTURE(i, j);
            const real_t expected = i != j
                                       ? (i < 3 && j < 3 ? H - 2.0 * mu : 0.0)
                                    : i < 3 ? H
                                            : mu;
            CHECK(std::abs(stiffness(i, j) - expected) <= 1e-12 * H);
         }
      }
      const Tensor3<> rest = StressOf(*law, IdentityTensor());
      for (int k = 0; k < 9; k++)
      {
         CHECK(std::abs(rest[k / 3][k % 3]) <= 1e-14 * H);
      }
   }
   CHECK(isotropic == 5);
   // Those of E and nu.
   const Made neo_hookean("neo_hookean", {{"E", 0.5}, {"nu", 0.1}});
   const Made holmes_mow("holmes_mow",
                         {{"E", 0.5}, {"nu", 0.1}, {"beta", 0.5}});
   const IsotropicElastic linear(0.5, 0.1);
   for (const Made *law : {&neo_hookean, &holmes_mow})
   {
      CHECK((*law)->AggregateModulus() == Approx(linear.AggregateModulus()));
      CHECK((*law)->ShearModulus() == Approx(linear.ShearModulus()));
   }
}

TEST_CASE("Linear laws strain when they turn", "[laws]")
{
   const Made isotropic("isotropic", {{"E", 1.0}, {"nu", 0.3}});
   const Made fibers("transversely_isotropic", {{"E_r", 0.5},
                                                {"E_theta", 5.0},
                                                {"nu_rtheta", 0.05},
                                                {"nu_rz", 0.3},
                                                {"G_rtheta", 0.4}});
   for (const Made *law : {&isotropic, &fibers})
   {
      CHECK_FALSE((*law)->IsObjective());
      AnyPoint point;
      CheckDerivative([&](const Tensor3<> &F, Tensor3<> &P, Tangent3 *tangent)
                      { return (*law)->GetStress(point.Get(), F, P, tangent); },
                      SomeDeformation());
      DenseMatrix stiffness;
      (*law)->GetStiffness(point.Get().trans, point.Get().ip, stiffness);
      Tensor3<> stretched = IdentityTensor();
      stretched[1][1] += 0.01;
      stretched[0][2] += 0.02;
      const Tensor3<> P = StressOf(**law, stretched);
      for (int v = 0; v < 6; v++)
      {
         CHECK(P[voigt_pairs[v][0]][voigt_pairs[v][1]] ==
               Approx(0.01 * stiffness(v, 1) + 0.02 * stiffness(v, 5))
                  .margin(1e-14));
      }
   }
}

TEST_CASE("A mixture bears what its parts bear", "[laws]")
{
   const Made ground("holmes_mow", {{"E", 1.0}, {"nu", 0.2}, {"beta", 0.35}});
   const Made fibers("fiber_nh", {{"mu", 2.0}});
   const Made linear("isotropic", {{"E", 1.0}, {"nu", 0.3}});
   const Made mixture("mixture", {}, {&*ground, &*fibers});
   const Tensor3<> F = SomeDeformation();
   CHECK(AreClose(StressOf(*ground, F) + StressOf(*fibers, F),
                  StressOf(*mixture, F), 1e-14));
   AnyPoint point;
   CheckDerivative([&](const Tensor3<> &G, Tensor3<> &P, Tangent3 *tangent)
                   { return mixture->GetStress(point.Get(), G, P, tangent); },
                   F);
   CHECK(mixture->AggregateModulus() == ground->AggregateModulus());
   CHECK(mixture->ShearModulus() == ground->ShearModulus());
   CHECK(mixture->IsObjective());
   CHECK_FALSE(Made("mixture", {}, {&*ground, &*linear})->IsObjective());
   CHECK_THROWS_WITH(Made("mixture", {}, {&*fibers}),
                     Catch::Contains("add a ground matrix"));
}

TEST_CASE("Fibers resist no compression", "[laws]")
{
   const CartesianFrame along_x(Point3{{1.0, 0.0, 0.0}});
   const Tensor3<> shorter{{{0.9, 0.0, 0.0}, {0.0, 1.1, 0.0}, {0.0, 0.0, 1.1}}};
   const Tensor3<> longer{{{1.2, 0.0, 0.0}, {0.0, 0.9, 0.0}, {0.0, 0.0, 0.9}}};
   int fibers = 0;
   for (const Sample &sample : Samples())
   {
      if (sample.name.rfind("fiber_", 0) != 0)
      {
         continue;
      }
      fibers++;
      CAPTURE(sample.name);
      const auto law = SolidLaws().Make(
         sample.name, {sample.values, along_x, solid_fraction, {}});
      Tangent3 tangent;
      const Tensor3<> P = StressOf(*law, shorter, &tangent);
      for (int k = 0; k < 9; k++)
      {
         CHECK(P[k / 3][k % 3] == 0.0);
         CHECK(tangent[k][k] == 0.0);
      }
      CHECK(StressOf(*law, longer)[0][0] > 0.0);
   }
   CHECK(fibers == 7);
   // s = mu (I_n - 1)/J N
   const FiberNh fiber(2.0, along_x);
   CHECK(PushedForward(StressOf(fiber, longer), longer)[0][0] ==
         Approx(2.0 * (1.44 - 1.0) / (1.2 * 0.81) * 1.44));
}

TEST_CASE("Fibers have the modulus that is said of them", "[laws]")
{
   const CartesianFrame along_x(Point3{{1.0, 0.0, 0.0}});
   const auto modulus = [](const SolidLaw &fibers, real_t stretch)
   {
      Tensor3<> F = IdentityTensor();
      F[0][0] = stretch;
      Tangent3 tangent;
      StressOf(fibers, F, &tangent);
      return tangent[0][0];
   };
   const real_t taut = 1.0 + 1e-7;
   CHECK(modulus(FiberNh(2.0, along_x), taut) == Approx(4.0).epsilon(1e-6));
   CHECK(modulus(FiberPow(3.0, 2.0, along_x), taut) ==
         Approx(24.0).epsilon(1e-6));
   CHECK(modulus(FiberExpPow(1.0, 2.0, 3.0, 0.0, 1.0, along_x), taut) ==
         Approx(12.0).epsilon(1e-6));
   CHECK(modulus(FiberNaturalNh(5.0, 1.0, along_x), taut) ==
         Approx(5.0).epsilon(1e-6));
   // Its toe meets the straight part with the same stress and stiffness.
   const FiberPowLinear toe(10.0, 1.1, 3.0, along_x);
   CHECK(modulus(toe, 1.1 - 1e-9) == Approx(modulus(toe, 1.1 + 1e-9)));
   Tensor3<> before = IdentityTensor();
   Tensor3<> beyond = IdentityTensor();
   before[0][0] = 1.1 - 1e-9;
   beyond[0][0] = 1.1 + 1e-9;
   CHECK(StressOf(toe, before)[0][0] ==
         Approx(StressOf(toe, beyond)[0][0]).epsilon(1e-6));
}

TEST_CASE("Undeformed fibers count as taut", "[laws]")
{
   AnyPoint point;
   int fibers = 0;
   for (const Sample &sample : Samples())
   {
      const Made law(sample.name, sample.values);
      if (law->AggregateModulus() > 0.0)
      {
         continue;
      }
      CAPTURE(sample.name);
      fibers++;
      // Within round-off, whichever side of 1 it is on.
      for (const real_t round_off : {-1e-15, 0.0, 1e-15})
      {
         const Tensor3<> F = (1.0 + round_off) * IdentityTensor();
         Tangent3 tangent;
         const Tensor3<> P = StressOf(*law, F, &tangent);
         for (int k = 0; k < 9; k++)
         {
            CHECK(std::abs(P[k / 3][k % 3]) < 1e-10);
            CHECK(std::isfinite(tangent[k][k]));
         }
      }
   }
   CHECK(fibers == 7);
   const CartesianFrame along_x(Point3{{1.0, 0.0, 0.0}});
   DenseMatrix stiffness;
   FiberNh(2.0, along_x)
      .GetStiffness(point.Get().trans, point.Get().ip, stiffness);
   CHECK(stiffness(0, 0) == Approx(4.0));
   CHECK(stiffness(1, 1) < 1e-10);
   FiberNaturalNh(2.0, 1.05, along_x)
      .GetStiffness(point.Get().trans, point.Get().ip, stiffness);
   CHECK(stiffness(0, 0) == 0.0);
}

TEST_CASE("A porous solid has no stress without pores", "[laws]")
{
   const Made porous("porous_neo_hookean", {{"E", 0.5}});
   Tensor3<> closed = IdentityTensor();
   closed[2][2] = 0.19;
   AnyPoint point;
   Tensor3<> P;
   CHECK_FALSE(porous->GetStress(point.Get(), closed, P, nullptr));
   closed[2][2] = 0.2001;
   CHECK(porous->GetStress(point.Get(), closed, P, nullptr));
   CHECK(P[2][2] < -100.0);
}

TEST_CASE("Fixed charges press", "[laws]")
{
   // p = 8.314e-6 310 (sqrt(150^2 + 300^2) - 300) in MPa
   const real_t pressure = 8.314e-6 * 310.0 * 35.410196624968454;
   const std::map<std::string, real_t> values{{"phiw0", 0.8},
                                              {"cF0", 150.0},
                                              {"bosm", 300.0},
                                              {"R", 8.314e-6},
                                              {"T", 310.0}};
   const Made donnan("donnan", values);
   Tangent3 tangent;
   const Tensor3<> P = StressOf(*donnan, IdentityTensor(), &tangent);
   for (int k = 0; k < 9; k++)
   {
      CHECK(P[k / 3][k % 3] ==
            Approx(k / 3 == k % 3 ? -pressure : 0.0).epsilon(1e-12));
   }
   // The charges get closer as fluid leaves.
   const real_t J = 0.7;
   const real_t charge = 0.8 * 150.0 / (J - 0.2);
   const Tensor3<> pressed{{{J, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
   CHECK(StressOf(*donnan, pressed)[0][0] ==
         Approx(-8.314e-6 * 310.0 * (std::hypot(charge, 300.0) - 300.0)));
   CHECK(donnan->AggregateModulus() == Approx(tangent[0][0]));
   CHECK(donnan->ShearModulus() == 0.0);
   AnyPoint point;
   Tensor3<> closed = IdentityTensor();
   closed[2][2] = 0.2;
   Tensor3<> stress;
   CHECK_FALSE(donnan->GetStress(point.Get(), closed, stress, nullptr));
   CHECK_THROWS_WITH(Donnan({1.0, 150.0, 300.0, 1.0, 1.0}),
                     "the volume fraction phiw0 of the fluid is 1; it must be "
                     "between 0 and 1");
}

TEST_CASE("Laws refuse what they can't be", "[laws]")
{
   const CartesianFrame frame(Point3{{1.0, 0.0, 0.0}});
   CHECK_THROWS_WITH(NeoHookean(0.0, 0.3),
                     "Young's modulus is 0; it must be positive");
   CHECK_THROWS_WITH(NeoHookean(1.0, 0.5),
                     "Poisson's ratio is 0.5; it must be between -1 and 0.5");
   CHECK_THROWS_WITH(HolmesMow(1.0, 0.3, -1.0),
                     "the exponent beta is -1; it must be positive");
   CHECK_THROWS_WITH(MooneyRivlin(0.0, 0.0, 1.0), Catch::Contains("c1 and c2"));
   CHECK_THROWS_WITH(PorousNeoHookean(1.0, 1.0),
                     Catch::Contains("solid fraction is 1"));
   CHECK_THROWS_WITH(
      FiberExpPow(0.0, 1.5, 1.0, 0.0, 1.0, frame),
      "the exponent beta of the fibers is 1.5; it must be at least 2");
   CHECK_THROWS_WITH(FiberPowLinear(1.0, 1.0, 2.0, frame),
                     Catch::Contains("it must be above 1"));
   CHECK_THROWS_AS(FiberNh(std::nan(""), frame), Error);
}
