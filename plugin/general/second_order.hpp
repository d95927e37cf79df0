#pragma once

#include "mfem.hpp"

#include <array>
#include <cmath>

namespace synovia
{

/// A number with its first and second derivatives by @a n variables, which
/// follow from those of what it is computed from.
template <int n>
struct SecondOrder
{
   using Gradient = std::array<mfem::real_t, n>;

   mfem::real_t value = 0.0;
   Gradient first{};
   std::array<Gradient, n> second{};

   SecondOrder() = default;
   /// A constant; implicit, so that it mixes with numbers.
   SecondOrder(mfem::real_t constant) : value(constant) {}
   /// One of the variables.
   static SecondOrder Variable(int i, mfem::real_t value)
   {
      SecondOrder variable(value);
      variable.first[i] = 1.0;
      return variable;
   }
};

/// f(x), with its derivatives there.
template <int n>
SecondOrder<n> Composed(const SecondOrder<n> &x, mfem::real_t f,
                        mfem::real_t f_x, mfem::real_t f_xx)
{
   SecondOrder<n> result(f);
   for (int i = 0; i < n; i++)
   {
      result.first[i] = f_x * x.first[i];
      for (int j = 0; j < n; j++)
      {
         result.second[i][j] =
            f_x * x.second[i][j] + f_xx * x.first[i] * x.first[j];
      }
   }
   return result;
}

/// f(x, y), of which @a partial are f, f_x, f_y, f_xx, f_xy, f_yy.
template <int n>
SecondOrder<n> Composed(const SecondOrder<n> &x, const SecondOrder<n> &y,
                        const std::array<mfem::real_t, 6> &partial)
{
   const auto [f, f_x, f_y, f_xx, f_xy, f_yy] = partial;
   SecondOrder<n> result(f);
   for (int i = 0; i < n; i++)
   {
      result.first[i] = f_x * x.first[i] + f_y * y.first[i];
      for (int j = 0; j < n; j++)
      {
         result.second[i][j] =
            f_x * x.second[i][j] + f_y * y.second[i][j] +
            f_xx * x.first[i] * x.first[j] + f_yy * y.first[i] * y.first[j] +
            f_xy * (x.first[i] * y.first[j] + y.first[i] * x.first[j]);
      }
   }
   return result;
}

template <int n>
SecondOrder<n> operator+(const SecondOrder<n> &x, const SecondOrder<n> &y)
{
   return Composed(x, y, {x.value + y.value, 1.0, 1.0, 0.0, 0.0, 0.0});
}

template <int n>
SecondOrder<n> operator-(const SecondOrder<n> &x, const SecondOrder<n> &y)
{
   return Composed(x, y, {x.value - y.value, 1.0, -1.0, 0.0, 0.0, 0.0});
}

template <int n>
SecondOrder<n> operator-(const SecondOrder<n> &x)
{
   return Composed(x, -x.value, -1.0, 0.0);
}

template <int n>
SecondOrder<n> operator*(const SecondOrder<n> &x, const SecondOrder<n> &y)
{
   return Composed(x, y, {x.value * y.value, y.value, x.value, 0.0, 1.0, 0.0});
}

template <int n>
SecondOrder<n> operator*(mfem::real_t a, const SecondOrder<n> &x)
{
   return Composed(x, a * x.value, a, 0.0);
}

/// Of a positive number.
template <int n>
SecondOrder<n> Sqrt(const SecondOrder<n> &x)
{
   const mfem::real_t root = std::sqrt(x.value);
   return Composed(x, root, 0.5 / root, -0.25 / (root * x.value));
}

template <int n>
SecondOrder<n> Inverse(const SecondOrder<n> &x)
{
   const mfem::real_t inverse = 1.0 / x.value;
   return Composed(x, inverse, -inverse * inverse,
                   2.0 * inverse * inverse * inverse);
}

/// The angle of the point (x, y), from -pi to pi.
template <int n>
SecondOrder<n> Atan2(const SecondOrder<n> &y, const SecondOrder<n> &x)
{
   const mfem::real_t s = x.value * x.value + y.value * y.value;
   const mfem::real_t twist = 2.0 * x.value * y.value / (s * s);
   return Composed(x, y,
                   {std::atan2(y.value, x.value), -y.value / s, x.value / s,
                    twist, (y.value * y.value - x.value * x.value) / (s * s),
                    -twist});
}

} // namespace synovia
