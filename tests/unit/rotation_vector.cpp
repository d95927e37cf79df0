// ranks: 1
//
// Rotation vectors: rotations, spins and their derivatives against central
// differences and against rotations in a row.

#include "synovia/fem/rotation_vector.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t step = 1e-5;

// Small ones are where series are used.
std::vector<Point3> Vectors()
{
   return {{{0.0, 0.0, 0.0}},        {{1e-3, -2e-3, 5e-4}},
           {{0.06, 0.05, -0.05}},    {{0.08, 0.05, -0.05}},
           {{0.3, -0.9, 0.4}},       {{-2.0, 1.5, 1.2}},
           {{0.0, 0.0, 0.5 * M_PI}}, {{3.0, -3.0, 2.0}}};
}

Point3 Shifted(const Point3 &theta, int component, real_t by)
{
   Point3 shifted(theta);
   shifted[component] += by;
   return shifted;
}

DenseMatrix Product(const DenseMatrix &a, const DenseMatrix &b)
{
   DenseMatrix product(3);
   Mult(a, b, product);
   return product;
}
} // namespace

TEST_CASE("A rotation keeps lengths and its axis, and turns by its angle")
{
   const Point3 quarter =
      Times(RotationMatrix({{0.0, 0.0, 0.5 * M_PI}}), {{1.0, 2.0, 3.0}});
   CHECK(quarter[0] == Approx(-2.0));
   CHECK(quarter[1] == Approx(1.0));
   CHECK(quarter[2] == Approx(3.0));
   for (const Point3 &theta : Vectors())
   {
      const DenseMatrix turn = RotationMatrix(theta);
      CHECK(turn.Det() == Approx(1.0).epsilon(1e-14));
      const Point3 axis = Times(turn, theta);
      CHECK(Length(Sum(axis, -1.0, theta)) <= 1e-14 * Length(theta));
      const Point3 back = TransposeTimes(turn, Times(turn, {{1.0, 2.0, 3.0}}));
      CHECK(Length(Sum(back, -1.0, {{1.0, 2.0, 3.0}})) < 1e-13);
   }
}

TEST_CASE("The spin of an increment is what its rotation differs by")
{
   for (const Point3 &theta : Vectors())
   {
      CAPTURE(theta[0], theta[1], theta[2]);
      const DenseMatrix spin = SpinMatrix(theta);
      for (int j = 0; j < 3; j++)
      {
         DenseMatrix difference = RotationMatrix(Shifted(theta, j, step));
         difference -= RotationMatrix(Shifted(theta, j, -step));
         difference *= 0.5 / step;
         const Point3 column{{spin(0, j), spin(1, j), spin(2, j)}};
         difference -= Product(CrossMatrix(column), RotationMatrix(theta));
         CHECK(difference.MaxMaxNorm() < 1e-9);
      }
   }
}

TEST_CASE("The derivative of the spin's transpose is that of differences")
{
   const Point3 moment{{0.7, -1.1, 0.4}};
   for (const Point3 &theta : Vectors())
   {
      CAPTURE(theta[0], theta[1], theta[2]);
      const DenseMatrix derivative = SpinTransposeDerivative(theta, moment);
      for (int j = 0; j < 3; j++)
      {
         Point3 difference =
            TransposeTimes(SpinMatrix(Shifted(theta, j, step)), moment);
         difference =
            Sum(difference, -1.0,
                TransposeTimes(SpinMatrix(Shifted(theta, j, -step)), moment));
         for (int i = 0; i < 3; i++)
         {
            CHECK(derivative(i, j) ==
                  Approx(0.5 * difference[i] / step).margin(1e-8));
         }
      }
   }
}

TEST_CASE("A shortened rotation vector is of the same rotation")
{
   int shortened = 0;
   for (const Point3 &theta : Vectors())
   {
      const Point3 other = Shortened(theta);
      CHECK(Length(other) <= M_PI + 1e-14);
      shortened += Length(other) < Length(theta) ? 1 : 0;
      DenseMatrix difference = RotationMatrix(theta);
      difference -= RotationMatrix(other);
      CHECK(difference.MaxMaxNorm() < 1e-13);
   }
   CHECK(shortened == 1);
}
