#include "synovia/fem/rotation_vector.hpp"

#include <cmath>
#include <vector>

namespace synovia
{

using namespace mfem;

namespace
{
/// A function of the angle, and its derivative over the angle.
struct AngleFunction
{
   real_t value;
   real_t slope;
};

// Below it, series are more accurate than differences.
constexpr real_t small = 0.1;

// first (1 - s/a (1 - s/b (1 - ...)))
real_t Series(real_t first, real_t s, const std::vector<real_t> &divisors)
{
   real_t sum = 1.0;
   for (auto divisor = divisors.rbegin(); divisor != divisors.rend(); divisor++)
   {
      sum = 1.0 - s / *divisor * sum;
   }
   return first * sum;
}

// sin a / a
AngleFunction Sine(real_t a)
{
   const real_t s = a * a;
   if (a < small)
   {
      return {Series(1.0, s, {6.0, 20.0, 42.0, 72.0}),
              Series(-1.0 / 3.0, s, {10.0, 28.0, 54.0, 88.0})};
   }
   return {std::sin(a) / a, (a * std::cos(a) - std::sin(a)) / (a * s)};
}

// (1 - cos a) / a^2
AngleFunction Versine(real_t a)
{
   const real_t s = a * a;
   if (a < small)
   {
      return {Series(0.5, s, {12.0, 30.0, 56.0, 90.0}),
              Series(-1.0 / 12.0, s, {15.0, 112.0 / 3.0, 67.5})};
   }
   return {(1.0 - std::cos(a)) / s,
           (a * std::sin(a) - 2.0 * (1.0 - std::cos(a))) / (s * s)};
}

// (a - sin a) / a^3
AngleFunction Excess(real_t a)
{
   const real_t s = a * a;
   if (a < small)
   {
      return {Series(1.0 / 6.0, s, {20.0, 42.0, 72.0, 110.0}),
              Series(-1.0 / 60.0, s, {21.0, 48.0, 82.5})};
   }
   return {(a - std::sin(a)) / (a * s),
           (a * (1.0 - std::cos(a)) - 3.0 * (a - std::sin(a))) / (a * s * s)};
}

// a b^T
DenseMatrix Outer(const Point3 &a, const Point3 &b)
{
   DenseMatrix product(3);
   for (int j = 0; j < 3; j++)
   {
      for (int i = 0; i < 3; i++)
      {
         product(i, j) = a[i] * b[j];
      }
   }
   return product;
}

// value I + turn [theta]x + along theta theta^T
DenseMatrix Combined(const Point3 &theta, real_t value, real_t turn,
                     real_t along)
{
   DenseMatrix sum = Outer(theta, theta);
   sum *= along;
   sum.Add(turn, CrossMatrix(theta));
   for (int d = 0; d < 3; d++)
   {
      sum(d, d) += value;
   }
   return sum;
}
} // namespace

DenseMatrix RotationMatrix(const Point3 &theta)
{
   const real_t angle = Length(theta);
   return Combined(theta, std::cos(angle), Sine(angle).value,
                   Versine(angle).value);
}

DenseMatrix SpinMatrix(const Point3 &theta)
{
   const real_t angle = Length(theta);
   return Combined(theta, Sine(angle).value, Versine(angle).value,
                   Excess(angle).value);
}

DenseMatrix SpinTransposeDerivative(const Point3 &theta, const Point3 &a)
{
   // Of f a - g theta x a + h theta (theta . a), with the functions f, g, h of
   // the angle.
   const real_t angle = Length(theta);
   const AngleFunction f = Sine(angle);
   const AngleFunction g = Versine(angle);
   const AngleFunction h = Excess(angle);
   const real_t along = Dot(theta, a);
   DenseMatrix sum = Outer(a, theta);
   sum *= f.slope;
   sum.Add(-g.slope, Outer(Cross(theta, a), theta));
   sum.Add(g.value, CrossMatrix(a));
   sum.Add(h.slope * along, Outer(theta, theta));
   sum.Add(h.value, Outer(theta, a));
   for (int d = 0; d < 3; d++)
   {
      sum(d, d) += h.value * along;
   }
   return sum;
}

Point3 Shortened(const Point3 &theta)
{
   const real_t angle = Length(theta);
   const real_t turns = std::round(angle / (2.0 * M_PI));
   return turns == 0.0 ? theta : Sum(theta, -2.0 * M_PI * turns / angle, theta);
}

DenseMatrix CrossMatrix(const Point3 &a)
{
   DenseMatrix cross(3);
   cross = 0.0;
   for (int d = 0; d < 3; d++)
   {
      cross((d + 2) % 3, (d + 1) % 3) = a[d];
      cross((d + 1) % 3, (d + 2) % 3) = -a[d];
   }
   return cross;
}

Point3 Times(const DenseMatrix &matrix, const Point3 &a)
{
   Point3 product;
   matrix.Mult(a.data(), product.data());
   return product;
}

Point3 TransposeTimes(const DenseMatrix &matrix, const Point3 &a)
{
   Point3 product;
   matrix.MultTranspose(a.data(), product.data());
   return product;
}

} // namespace synovia
