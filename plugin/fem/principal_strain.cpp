#include "synovia/fem/principal_strain.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace synovia
{

using namespace mfem;

DenseMatrix GreenStrain(const DenseMatrix &gradient)
{
   DenseMatrix strain(3);
   MultAtB(gradient, gradient, strain);
   strain += gradient;
   DenseMatrix transpose(gradient);
   transpose.Transpose();
   strain += transpose;
   strain *= 0.5;
   return strain;
}

real_t LogarithmicStrain(real_t green)
{
   constexpr real_t least = std::numeric_limits<real_t>::min();
   const real_t square = 1.0 + 2.0 * green;
   return square > 0.5 ? 0.5 * std::log1p(2.0 * green)
                       : 0.5 * std::log(std::max(square, least));
}

} // namespace synovia
