#pragma once

#include "synovia/general/point3.hpp"

namespace synovia
{

/// Rows of a 3 x 3 matrix.
using Matrix3 = std::array<Point3, 3>;

/// The smallest rotation that takes a unit vector @a from to @a to, applied to
/// a vector @a v across @a from. Where either is null, or both are opposite, v
/// across @a to.
///
///     R v = v - (v.to) (from + to) / (1 + from.to)
class TangentialTurn
{
public:
   TangentialTurn(const Point3 &from_, const Point3 &to_)
      : from(from_), to(to_), sum(Sum(from, 1.0, to)),
        scale(1.0 + Dot(from, to)), turns(Length(from) > 0.5 && scale > 0.5)
   {
   }

   Point3 operator()(const Point3 &v) const
   {
      return Sum(v, -Dot(v, to) / (turns ? scale : 1.0), turns ? sum : to);
   }

   /// d(R v)/d(to), for a fixed v.
   Matrix3 Derivative(const Point3 &v) const
   {
      const mfem::real_t along = Dot(v, to);
      const mfem::real_t c = turns ? scale : 1.0;
      Matrix3 derivative;
      for (int i = 0; i < 3; i++)
      {
         for (int j = 0; j < 3; j++)
         {
            const mfem::real_t by_scale = turns ? along / c * from[j] : 0.0;
            derivative[i][j] = -(v[j] - by_scale) / c * (turns ? sum : to)[i];
         }
         derivative[i][i] -= along / c;
      }
      return derivative;
   }

private:
   Point3 from;
   Point3 to;
   Point3 sum;
   mfem::real_t scale;
   bool turns;
};

} // namespace synovia
