// ranks: 1
//
// Fibers in all directions: sums over directions against sums of laws of
// fibers, which have tangents by dual numbers; against integrals in closed form
// and by a fine rule; and what the densities are.

#include "support/deformed_point.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>

using namespace mfem;
using namespace synovia;

namespace
{
const Point3 beta{{3.0, 2.5, 2.0}};
const Point3 xi{{1.0, 3.0, 5.0}};
constexpr real_t sphere = 4.0 * M_PI;

CartesianFrame SomeFrame()
{
   const Vector3<> n = SomeDirection();
   return CartesianFrame(Point3{{n[0], n[1], n[2]}});
}

real_t Ellipsoid(const Point3 &semiaxes, const Vector3<> &n)
{
   return 1.0 / std::hypot(n[0] / semiaxes[0], n[1] / semiaxes[1],
                           n[2] / semiaxes[2]);
}

Point3 ComponentsOf(const Vector3<> &n)
{
   return {n[0], n[1], n[2]};
}

Tensor3<> Diagonal(real_t x, real_t y, real_t z)
{
   return {{{x, 0.0, 0.0}, {0.0, y, 0.0}, {0.0, 0.0, z}}};
}

Tensor3<> StressOf(const SolidLaw &law, const Tensor3<> &F,
                   Tangent3 *tangent = nullptr)
{
   AnyPoint point;
   Tensor3<> P;
   REQUIRE(law.GetStress(point.Get(), F, P, tangent));
   return P;
}

/// Laws of fibers along the directions of a rule, with weights.
class ManyFibers
{
public:
   void Add(std::unique_ptr<SolidLaw> law, real_t weight)
   {
      laws.push_back(std::move(law));
      weights.push_back(weight);
   }
   Tensor3<> Stress(const Tensor3<> &F, Tangent3 &tangent) const
   {
      Tensor3<> sum{};
      tangent = Tangent3{};
      for (size_t i = 0; i < laws.size(); i++)
      {
         Tangent3 own;
         sum += weights[i] * StressOf(*laws[i], F, &own);
         tangent += weights[i] * own;
      }
      return sum;
   }

private:
   std::vector<std::unique_ptr<SolidLaw>> laws;
   std::vector<real_t> weights;
};

void CheckSame(const SolidLaw &law, const ManyFibers &fibers)
{
   const Tensor3<> F = SomeDeformation();
   Tangent3 expected_tangent;
   const Tensor3<> expected = fibers.Stress(F, expected_tangent);
   Tangent3 tangent;
   CHECK(AreClose(expected, StressOf(law, F, &tangent), 1e-12));
   CHECK(AreClose(expected, StressOf(law, F), 1e-12));
   real_t largest = 0.0;
   real_t difference = 0.0;
   for (int k = 0; k < 81; k++)
   {
      const real_t one = expected_tangent[k / 9][k % 9];
      largest = std::max(largest, std::abs(one));
      difference = std::max(difference, std::abs(one - tangent[k / 9][k % 9]));
   }
   CHECK(largest > 0.0);
   CHECK(difference < 1e-11 * largest);
}

/// By a law's definition: the density of fibers along n, up to a factor, and
/// Psi' at I_n, which is above 1.
struct Definition
{
   std::function<real_t(const Vector3<> &n)> density;
   std::function<real_t(const Vector3<> &n, real_t square)> slope;
};

/// Integrals over the sphere by a rule of its own.
struct FineIntegrals
{
   /// Of 2 Psi' n n, the second Piola-Kirchhoff stress in the frame's axes.
   Tensor3<> stress{};
   /// Of the density, over all fibers and over those that are taut.
   real_t fibers = 0.0;
   real_t taut = 0.0;
};

/// By Gauss points in the height and equal angles.
FineIntegrals IntegrateFinely(const Definition &law, const Tensor3<> &C)
{
   constexpr int heights = 150;
   const IntegrationRule &rule =
      IntRules.Get(Geometry::SEGMENT, 2 * heights - 1);
   FineIntegrals sum;
   for (int q = 0; q < rule.GetNPoints(); q++)
   {
      const real_t z = rule.IntPoint(q).x; // of half the sphere
      const real_t s = std::sqrt(1.0 - z * z);
      for (int k = 0; k < 4 * heights; k++)
      {
         const real_t angle = 2.0 * M_PI * (k + 0.5) / (4 * heights);
         const Vector3<> n{s * std::cos(angle), s * std::sin(angle), z};
         const real_t weight = 2.0 * rule.IntPoint(q).weight * 2.0 * M_PI /
                               (4 * heights) * law.density(n);
         const real_t square = InnerProduct(n, Product(C, n));
         sum.fibers += weight;
         if (square > 1.0)
         {
            sum.taut += weight;
            AddOuterProduct(2.0 * weight * law.slope(n, square), n, n,
                            sum.stress);
         }
      }
   }
   return sum;
}

/// Of exponents and moduli that are ellipsoids.
Definition Ellipsoidal(const Point3 &exponents, const Point3 &moduli)
{
   return {[](const Vector3<> &) { return 1.0; },
           [=](const Vector3<> &n, real_t square)
           {
              const real_t power = Ellipsoid(exponents, n);
              return power * Ellipsoid(moduli, n) *
                     std::pow(square - 1.0, power - 1.0);
           }};
}

/// The stress P of a deformation F from S in the axes of a frame.
Tensor3<> FirstStress(const Tensor3<> &F, const Tensor3<> &axes,
                      const Tensor3<> &S)
{
   return Product(Product(Product(F, axes), S),
                  TransposedProduct(axes, IdentityTensor()));
}
} // namespace

TEST_CASE("Directions stand for the sphere", "[fibers]")
{
   for (const int divisions : {1, 4, 10})
   {
      const std::vector<WeightedDirection> rule = DirectionRule(divisions);
      CHECK(static_cast<int>(rule.size()) == 4 * divisions * divisions);
      real_t sum = 0.0;
      Tensor3<> second{};
      real_t fourth[3] = {0.0, 0.0, 0.0};
      for (const WeightedDirection &one : rule)
      {
         const Vector3<> &n = one.direction;
         CHECK(InnerProduct(n, n) == Approx(1.0).epsilon(1e-14));
         sum += one.weight;
         AddOuterProduct(one.weight, n, n, second);
         for (int d = 0; d < 3; d++)
         {
            fourth[d] += one.weight * std::pow(n[d], 4);
         }
      }
      CHECK(sum == Approx(sphere).epsilon(1e-13));
      for (int k = 0; k < 9; k++)
      {
         const real_t expected = k / 3 == k % 3 ? sphere / 3.0 : 0.0;
         CHECK(std::abs(second[k / 3][k % 3] - expected) < 1e-12);
      }
      const real_t tolerance = divisions == 10 ? 2e-4 : 0.5;
      for (const real_t moment : fourth)
      {
         CHECK(std::abs(moment / (sphere / 5.0) - 1.0) < tolerance);
      }
   }
}

TEST_CASE("A distribution is the sum of its fibers", "[fibers]")
{
   const CartesianFrame frame = SomeFrame();
   SECTION("ellipsoidal")
   {
      ManyFibers fibers;
      for (const WeightedDirection &one : DirectionRule(10))
      {
         fibers.Add(std::make_unique<FiberPow>(
                       Ellipsoid(xi, one.direction),
                       Ellipsoid(beta, one.direction),
                       FiberDirection(frame, ComponentsOf(one.direction))),
                    one.weight);
      }
      CheckSame(EllipsoidalFiberDistribution(beta, xi, frame), fibers);
   }
   SECTION("continuous")
   {
      const FiberDensity density{1.5, {{1.0, 2.0, 1.5}}};
      const FiberExpPow law(1.0, 2.5, 3.0, 0.0, 1.02, frame);
      ManyFibers fibers;
      for (const WeightedDirection &one : density.Rule())
      {
         fibers.Add(std::make_unique<FiberExpPow>(
                       1.0, 2.5, 3.0, 0.0, 1.02,
                       FiberDirection(frame, ComponentsOf(one.direction))),
                    one.weight);
      }
      CheckSame(ContinuousFiberDistribution(law, density, frame), fibers);
   }
}

TEST_CASE("Tangents of distributions are derivatives, and they turn",
          "[fibers]")
{
   const CartesianFrame frame = SomeFrame();
   const FiberNaturalNh natural(3.0, 1.0, frame);
   const FiberPowLinear linear(10.0, 1.05, 3.0, frame);
   const EllipsoidalFiberDistribution ellipsoidal(beta, xi, frame);
   const ContinuousFiberDistribution spread(natural, FiberDensity(), frame);
   const ContinuousFiberDistribution along(linear, {4.0}, frame);
   for (const SolidLaw *law :
        std::vector<const SolidLaw *>{&ellipsoidal, &spread, &along})
   {
      AnyPoint point;
      CheckDerivative([&](const Tensor3<> &F, Tensor3<> &P, Tangent3 *tangent)
                      { return law->GetStress(point.Get(), F, P, tangent); },
                      SomeDeformation());
      CHECK(law->IsObjective());
      const Tensor3<> F = SomeDeformation();
      const Tensor3<> Q = SomeRotation();
      CHECK(AreClose(Product(Q, StressOf(*law, F)),
                     StressOf(*law, Product(Q, F)), 1e-12));
      CHECK(law->AggregateModulus() == 0.0);
      CHECK(law->ShearModulus() == 0.0);
   }
}

TEST_CASE("The integral goes over the whole sphere", "[fibers]")
{
   // The same stretch in all directions: for equal constants
   // P = 2 beta xi (I_n - 1)^(beta - 1) lambda 4 pi/3.
   const CartesianFrame frame = SomeFrame();
   const EllipsoidalFiberDistribution equal({{2.5, 2.5, 2.5}},
                                            {{3.0, 3.0, 3.0}}, frame);
   const real_t stretch = 1.1;
   const real_t tension =
      2.0 * 2.5 * 3.0 * std::pow(stretch * stretch - 1.0, 1.5);
   const Tensor3<> P = StressOf(equal, Diagonal(stretch, stretch, stretch));
   CHECK(
      AreClose(tension * stretch * sphere / 3.0 * IdentityTensor(), P, 1e-12));
   // A mean is not multiplied by the area, whatever the density.
   const FiberPow fiber(3.0, 2.5, frame);
   for (const real_t concentration : {0.0, 2.0, 30.0})
   {
      const ContinuousFiberDistribution mean(
         fiber, {concentration, {{1.0, 2.0, 3.0}}}, frame);
      CHECK(Trace(StressOf(mean, Diagonal(stretch, stretch, stretch))) ==
            Approx(tension * stretch).epsilon(1e-12));
   }
   CHECK(StressOf(equal, Diagonal(0.9, 0.9, 0.9))[0][0] == 0.0);
}

TEST_CASE("Sums are near the integrals, where part of the fibers is slack",
          "[fibers]")
{
   const CartesianFrame frame(Point3{{0.0, 1.0, 0.0}});
   SECTION("in closed form")
   {
      // beta = 2, longer across z by a, shorter along it by c: with
      // A = a^2 - 1 those with n_z < t are taut, t^2 = A / (a^2 - c^2), and
      // I_n - 1 = A (1 - n_z^2/t^2).
      const real_t a = 1.05;
      const real_t c = GENERATE(0.5, 0.8, 0.95);
      // Those that are taut at 0.5 are a band of 20 degrees about the equator.
      const real_t tolerance = c < 0.6 ? 0.02 : 0.01;
      const real_t A = a * a - 1.0;
      const real_t t = std::sqrt(A / (a * a - c * c));
      const real_t modulus = 3.0;
      const EllipsoidalFiberDistribution law(
         {{2.0, 2.0, 2.0}}, {{modulus, modulus, modulus}}, frame);
      const Tensor3<> P = StressOf(law, Diagonal(a, a, c));
      const real_t along = 16.0 * M_PI * modulus * A * t * t * t * 2.0 / 15.0;
      const real_t across =
         8.0 * M_PI * modulus * A * (2.0 / 3.0 * t - 2.0 / 15.0 * t * t * t);
      CHECK(std::abs(P[2][2] / c - along) < tolerance * across);
      CHECK(std::abs(P[0][0] / a - across) < tolerance * across);
      CHECK(std::abs(P[1][1] / a - across) < tolerance * across);
   }
   SECTION("by a fine rule")
   {
      // The axes of the frame are those of space but for their order.
      AnyPoint point;
      const Tensor3<> axes = frame.GetAxes(point.Get());
      const Tensor3<> Q = SomeRotation();
      int checked = 0;
      for (const Point3 &exponents : {beta, Point3{{2.0, 2.0, 2.0}}})
      {
         const EllipsoidalFiberDistribution law(exponents, xi, frame);
         for (const Tensor3<> &F :
              {Diagonal(1.02, 1.02, 0.9), Diagonal(1.1, 0.97, 0.97),
               Diagonal(0.999, 1.0002, 1.0005), SomeDeformation(),
               Product(Product(Q, Diagonal(1.02, 1.02, 0.9)),
                       TransposedProduct(Q, IdentityTensor()))})
         {
            const Tensor3<> F_q = Product(F, axes);
            const FineIntegrals fine = IntegrateFinely(
               Ellipsoidal(exponents, xi), TransposedProduct(F_q, F_q));
            const Tensor3<> expected = FirstStress(F, axes, fine.stress);
            CHECK(AreClose(expected, StressOf(law, F), 0.01));
            checked++;
         }
      }
      CHECK(checked == 10);
   }
}

TEST_CASE("The stress of a von Mises distribution is its integral", "[fibers]")
{
   // Of fibers in powers and in logarithms, one without stiffness where they
   // get taut and one with it.
   const CartesianFrame frame = SomeFrame();
   AnyPoint point;
   const Tensor3<> axes = frame.GetAxes(point.Get());
   const FiberPow power(3.0, 2.5, frame);
   const FiberNaturalNh natural(3.0, 1.0, frame);
   const bool stiff = GENERATE(false, true);
   const real_t b = GENERATE(0.0, 3.0, 10.0);
   Definition definition;
   definition.density = [&](const Vector3<> &n)
   { return std::exp(b * (2.0 * n[1] * n[1] - 1.0)); };
   definition.slope = [&](const Vector3<> &, real_t square)
   {
      return stiff ? 3.0 * std::log(std::sqrt(square)) / (2.0 * square)
                   : 3.0 * 2.5 * std::pow(square - 1.0, 1.5);
   };
   const FiberEnergy &fibers =
      stiff ? static_cast<const FiberEnergy &>(natural) : power;
   const ContinuousFiberDistribution law(fibers, {b}, frame);
   struct Deformed
   {
      Tensor3<> in_frame;
      real_t tolerance;
   };
   // Taut is about half of the sphere; all that is turned from theta towards r,
   // the tail of a density, which the rule for b = 10 has no better than within
   // some percent; a cone of 16 to 21 degrees about theta; and one of 12 to 13,
   // a fortieth of the sphere, where few of the sum's directions are.
   const Tensor3<> sheared{
      {{1.0, 0.3, 0.0}, {0.0, 0.93, 0.1}, {0.0, 0.0, 0.9}}};
   const std::vector<Deformed> all{
      {Diagonal(0.9, 1.02, 1.02), 0.01},
      {sheared, 0.01},
      {Diagonal(1.1, 1.0, 0.9), b < 5.0 ? 0.0125 : 0.045},
      {Diagonal(0.85, 1.02, 0.7), 0.015},
      {Diagonal(0.8, 1.01, 0.75), 0.04}};
   for (const Deformed &one : all)
   {
      const Tensor3<> F = Product(Product(SomeRotation(), one.in_frame),
                                  TransposedProduct(axes, IdentityTensor()));
      const FineIntegrals fine = IntegrateFinely(
         definition, TransposedProduct(one.in_frame, one.in_frame));
      const Tensor3<> expected =
         FirstStress(F, axes, (1.0 / fine.fibers) * fine.stress);
      CAPTURE(stiff, b, fine.taut / fine.fibers, law.Directions());
      CHECK(fine.taut > 0.02 * fine.fibers);
      CHECK(fine.taut < 0.995 * fine.fibers);
      CHECK(AreClose(expected, StressOf(law, F), one.tolerance));
   }
}

TEST_CASE("Undeformed distributions count as taut", "[fibers]")
{
   const CartesianFrame frame = SomeFrame();
   const EllipsoidalFiberDistribution law({{2.0, 2.0, 2.0}}, {{3.0, 3.0, 3.0}},
                                          frame);
   AnyPoint point;
   DenseMatrix stiffness;
   law.GetStiffness(point.Get().trans, point.Get().ip, stiffness);
   // 8 xi int n n n n = 8 xi 4 pi/15 (d d + d d + d d)
   const real_t unit = 8.0 * 3.0 * sphere / 15.0;
   for (int i = 0; i < 6; i++)
   {
      for (int j = 0; j < 6; j++)
      {
         const real_t expected = i == j           ? (i < 3 ? 3.0 * unit : unit)
                                 : i < 3 && j < 3 ? unit
                                                  : 0.0;
         CAPTURE(i, j);
         CHECK(std::abs(stiffness(i, j) - expected) < 1e-3 * unit);
      }
   }
}

TEST_CASE("Densities are what they say", "[fibers]")
{
   const auto mean_squares = [](const std::vector<WeightedDirection> &rule)
   {
      Point3 mean{{0.0, 0.0, 0.0}};
      real_t sum = 0.0;
      for (const WeightedDirection &one : rule)
      {
         sum += one.weight;
         for (int d = 0; d < 3; d++)
         {
            mean[d] += one.weight * one.direction[d] * one.direction[d];
         }
      }
      CHECK(sum == Approx(1.0).epsilon(1e-6));
      return mean;
   };
   SECTION("von Mises")
   {
      const real_t b = GENERATE(0.0, 0.5, 3.0, 10.0, 50.0);
      // int u^2 exp(2 b u^2) du / int exp(2 b u^2) du
      const IntegrationRule &rule = IntRules.Get(Geometry::SEGMENT, 201);
      real_t weighted = 0.0;
      real_t all = 0.0;
      for (int q = 0; q < rule.GetNPoints(); q++)
      {
         const real_t u = rule.IntPoint(q).x;
         const real_t density =
            rule.IntPoint(q).weight * std::exp(2.0 * b * (u * u - 1.0));
         weighted += density * u * u;
         all += density;
      }
      const FiberDensity density{b};
      const Point3 mean = mean_squares(density.Rule());
      CHECK(std::abs(mean[1] - weighted / all) < 2e-3);
      CHECK(mean[0] == Approx(mean[2]).epsilon(1e-6));
   }
   SECTION("ellipsoidal")
   {
      // Twice as many along theta as across.
      FiberDensity density;
      density.semiaxes = {{1.0, 2.0, 1.0}};
      CHECK(density({0.0, 1.0, 0.0}) ==
            Approx(2.0 * density({1.0, 0.0, 0.0})).epsilon(1e-14));
      const Point3 mean = mean_squares(density.Rule());
      CHECK(mean[0] == Approx(mean[2]).epsilon(1e-12));
      // R = 1/sqrt(1 - 3/4 u^2): int R du = 4/sqrt(3) asin(sqrt(3)/2) and
      // int u^2 R du, from -1 to 1.
      const real_t k = std::sqrt(0.75);
      const real_t all = std::asin(k) / k;
      const real_t weighted =
         (std::asin(k) / k - std::sqrt(1.0 - k * k)) / (2.0 * k * k);
      CHECK(mean[1] == Approx(weighted / all).epsilon(2e-3));
   }
}

TEST_CASE("Distributions refuse what they can't be", "[fibers]")
{
   const CartesianFrame frame = SomeFrame();
   const FiberPow fiber(3.0, 2.5, frame);
   const FiberExpPow sheared(1.0, 2.0, 3.0, 0.1, 1.0, frame);
   CHECK_THROWS_WITH(
      EllipsoidalFiberDistribution({{2.0, 1.5, 2.0}}, xi, frame),
      "the exponents beta along r, theta, z is [2, 1.5, 2]; each number must "
      "be at least 2");
   CHECK_THROWS_WITH(
      EllipsoidalFiberDistribution(beta, {{1.0, 0.0, 1.0}}, frame),
      Catch::Contains("[1, 0, 1]; each number must be positive"));
   CHECK_THROWS_WITH(ContinuousFiberDistribution(fiber, {-1.0}, frame),
                     Catch::Contains("concentration b of the fibers about "
                                     "theta is -1; it must be"));
   CHECK_THROWS_WITH(
      ContinuousFiberDistribution(fiber, {0.0, {{1.0, -1.0, 1.0}}}, frame),
      Catch::Contains("semiaxes spa"));
   CHECK_THROWS_WITH(ContinuousFiberDistribution(sheared, {}, frame),
                     Catch::Contains("set their shear modulus mu to 0"));
   CHECK_THROWS_WITH(ContinuousFiberDistribution(fiber, {1e4}, frame),
                     Catch::Contains("concentration b of the fibers about "
                                     "theta is 10000; it must be"));
   CHECK_THROWS_WITH(
      SolidLaws().Make("continuous_fiber_distribution", {{}, frame, 0.2, {}}),
      Catch::Contains("made of one law of fibers"));
   CHECK_THROWS_WITH(
      SolidLaws().Make("ellipsoidal_fiber_distribution", {{}, frame, 0.2, {}}),
      "beta of \"ellipsoidal_fiber_distribution\" is missing "
      "(the exponents beta along r, theta, z)");
}
