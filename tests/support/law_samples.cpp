#include "support/law_samples.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
using Complex3 = std::array<std::array<Complex, 3>, 3>;

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

// c1 = 0.7, c2 = 0.3, c4 = 12, c5 = 5, k = 20.
Complex UncoupledMooneyRivlinEnergy(const Invariants &of, real_t c3,
                                    real_t straight)
{
   const Complex log_J = std::log(of.J);
   const Complex shape = std::pow(of.J, -2.0 / 3.0);
   const Complex stretch = std::sqrt(shape * of.In);
   const auto tension = [c3](const Complex &l)
   { return c3 * (std::exp(12.0 * (l - 1.0)) - 1.0); };
   const bool is_straight = stretch.real() > straight;
   const Complex end = is_straight ? Complex(straight) : stretch;
   // Simpson's rule for the integral of the tension over the logarithm.
   constexpr int panels = 500;
   Complex fibers = 0.0;
   for (int i = 0; i <= 2 * panels; i++)
   {
      const Complex l = 1.0 + 0.5 * i / panels * (end - 1.0);
      const real_t weight = i == 0 || i == 2 * panels ? 1.0
                            : i % 2 == 1              ? 4.0
                                                      : 2.0;
      fibers += weight * tension(l) / l * (end - 1.0) / (6.0 * panels);
   }
   if (is_straight)
   {
      const Complex offset = tension(straight) - 5.0 * straight;
      fibers +=
         5.0 * (stretch - straight) + offset * std::log(stretch / straight);
   }
   return 0.7 * (shape * of.I1 - 3.0) + 0.3 * (shape * shape * of.I2 - 3.0) +
          10.0 * log_J * log_J + fibers;
}
} // namespace

std::vector<LawSample> LawSamples()
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
          const real_t pores = 1.0 - sample_solid_fraction;
          const real_t mu = 0.5 / 3.0 * (1.0 + 0.5 * pores * pores);
          const Complex Jb = (of.J - sample_solid_fraction) / pores;
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
      {"prlig",
       {{"c1", 3.0},
        {"c2", 10.0},
        {"mu", 0.4},
        {"v0", 1.2},
        {"m", -2.0},
        {"k", 0.7}},
       [](const Invariants &of)
       {
          const Complex stretch = std::sqrt(of.In);
          const Complex excess = stretch - 1.0;
          const Complex area = of.I2 - of.I1 * of.In + of.In2;
          const Complex volume =
             std::log(area) + 12.8 * std::log(stretch) - 8.0 * excess;
          return 0.15 * (std::exp(10.0 * excess * excess) - 1.0) +
                 0.4 * (0.5 * (of.I1 - 3.0) - std::log(of.J)) +
                 0.35 * volume * volume;
       }},
      {"trans_iso_mooney_rivlin",
       {{"c1", 0.7},
        {"c2", 0.3},
        {"c3", 0.2},
        {"c4", 12.0},
        {"c5", 5.0},
        {"lam_max", 1.5},
        {"k", 20.0}},
       [](const Invariants &of)
       { return UncoupledMooneyRivlinEnergy(of, 0.2, 1.5); }},
      {"trans_iso_mooney_rivlin",
       {{"c1", 0.7},
        {"c2", 0.3},
        {"c4", 12.0},
        {"c5", 5.0},
        {"lam_max", 1.01},
        {"k", 20.0}},
       [](const Invariants &of)
       {
          return UncoupledMooneyRivlinEnergy(
             of, 5.0 / 12.0 * std::exp(-12.0 * 0.01), 1.01);
       }},
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

Tensor3<> EnergyDerivative(const LawSample &sample, const Tensor3<> &F)
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
      derivative[k / 3][k % 3] =
         sample.energy(InvariantsOf(disturbed)).imag() / step;
   }
   return derivative;
}

SampledLaw::SampledLaw(const std::string &name,
                       const std::map<std::string, real_t> &values,
                       const std::vector<const SolidLaw *> &parts)
   : frame(
        Point3{{SomeDirection()[0], SomeDirection()[1], SomeDirection()[2]}}),
     law(SolidLaws().Make(name, {values, frame, sample_solid_fraction, parts}))
{
}

Tensor3<> StressOf(const SolidLaw &law, const Tensor3<> &F, Tangent3 *tangent)
{
   AnyPoint point;
   Tensor3<> P;
   REQUIRE(law.GetStress(point.Get(), F, P, tangent));
   return P;
}

} // namespace synovia
