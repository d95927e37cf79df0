#include "synovia/materials/fiber_density.hpp"
#include "synovia/general/error.hpp"

#include <algorithm>
#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
constexpr int divisions[] = {10, 14, 20, 28, 40};
constexpr int fine_divisions = 80;
// Of the largest weight, below which a direction doesn't count.
constexpr real_t negligible = 1e-8;
constexpr real_t tolerance = 1e-3;

std::vector<WeightedDirection> Weighted(const FiberDensity &density, int parts)
{
   std::vector<WeightedDirection> rule = DirectionRule(parts);
   real_t largest = 0.0;
   for (WeightedDirection &one : rule)
   {
      one.weight *= density(one.direction);
      largest = std::max(largest, one.weight);
   }
   const auto is_negligible = [&](const WeightedDirection &one)
   { return one.weight < negligible * largest; };
   rule.erase(std::remove_if(rule.begin(), rule.end(), is_negligible),
              rule.end());
   real_t sum = 0.0;
   for (const WeightedDirection &one : rule)
   {
      sum += one.weight;
   }
   for (WeightedDirection &one : rule)
   {
      one.weight /= sum;
   }
   return rule;
}

// The means of n_i^2 and n_i^2 n_j^2.
std::vector<real_t> EvenMoments(const std::vector<WeightedDirection> &rule)
{
   std::vector<real_t> moments(9, 0.0);
   for (const WeightedDirection &one : rule)
   {
      const Vector3<> &n = one.direction;
      for (int i = 0; i < 3; i++)
      {
         const int j = (i + 1) % 3;
         const real_t square = one.weight * n[i] * n[i];
         moments[i] += square;
         moments[3 + i] += square * n[i] * n[i];
         moments[6 + i] += square * n[j] * n[j];
      }
   }
   return moments;
}
} // namespace

real_t FiberDensity::operator()(const Vector3<> &n) const
{
   real_t square = 0.0;
   for (int i = 0; i < 3; i++)
   {
      square += n[i] * n[i] / (semiaxes[i] * semiaxes[i]);
   }
   // Largest at 1, so that it can't overflow.
   return std::exp(2.0 * concentration * (n[1] * n[1] - 1.0)) /
          std::sqrt(square);
}

std::vector<WeightedDirection> FiberDensity::Rule() const
{
   const std::vector<real_t> exact =
      EvenMoments(Weighted(*this, fine_divisions));
   for (const int parts : divisions)
   {
      std::vector<WeightedDirection> rule = Weighted(*this, parts);
      const std::vector<real_t> moments = EvenMoments(rule);
      real_t error = 0.0;
      for (size_t k = 0; k < moments.size(); k++)
      {
         error = std::max(error, std::abs(moments[k] - exact[k]));
      }
      if (error < tolerance)
      {
         return rule;
      }
   }
   throw Error("the fibers are so much alike in direction that a distribution "
               "of them can't be resolved; take fibers of one direction");
}

} // namespace synovia
