#include "synovia/materials/fiber_distribution.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
// Where x^(order - y - z) y^y z^z is among the products of so many components.
constexpr int Place(int order, int y, int z)
{
   return y * (order + 1) - y * (y - 1) / 2 + z;
}

constexpr int PlaceOf(int a, int b)
{
   return Place(2, (a == 1) + (b == 1), (a == 2) + (b == 2));
}

constexpr int fourth = 6;

constexpr int PlaceOf(int a, int b, int c, int d)
{
   return fourth + Place(4, (a == 1) + (b == 1) + (c == 1) + (d == 1),
                         (a == 2) + (b == 2) + (c == 2) + (d == 2));
}

void SetProducts(const Vector3<> &n, real_t *products)
{
   for (int a = 0; a < 3; a++)
   {
      for (int b = a; b < 3; b++)
      {
         products[PlaceOf(a, b)] = n[a] * n[b];
         for (int c = b; c < 3; c++)
         {
            for (int d = c; d < 3; d++)
            {
               products[PlaceOf(a, b, c, d)] = n[a] * n[b] * n[c] * n[d];
            }
         }
      }
   }
}

// dP/dF of S = sum S_ab q_a q_b in axes q, and of dS/dC, half of it: the fourth
// moments. F_q are the axes' images, F q_a.
void SetTangent(const real_t *sums, const Tensor3<> &S, const Tensor3<> &axes,
                const Tensor3<> &F_q, Tangent3 &tangent)
{
   Tangent3 map;
   Tangent3 stiffness;
   for (int i = 0; i < 3; i++)
   {
      for (int j = 0; j < 3; j++)
      {
         for (int a = 0; a < 3; a++)
         {
            for (int b = 0; b < 3; b++)
            {
               map[3 * i + j][3 * a + b] = F_q[i][a] * axes[j][b];
               stiffness[3 * i + j][3 * a + b] = sums[PlaceOf(i, j, a, b)];
            }
         }
      }
   }
   Tangent3 half{};
   for (int i = 0; i < 9; i++)
   {
      for (int k = 0; k < 9; k++)
      {
         for (int j = 0; j < 9; j++)
         {
            half[i][j] += map[i][k] * stiffness[k][j];
         }
      }
   }
   for (int i = 0; i < 9; i++)
   {
      for (int j = 0; j < 9; j++)
      {
         real_t sum = i / 3 == j / 3 ? S[i % 3][j % 3] : 0.0;
         for (int k = 0; k < 9; k++)
         {
            sum += half[i][k] * map[j][k];
         }
         tangent[i][j] = sum;
      }
   }
}
} // namespace

FiberDistribution::FiberDistribution(const std::vector<WeightedDirection> &rule,
                                     const MaterialFrame &frame_)
   : frame(frame_), directions(rule.size())
{
   for (size_t i = 0; i < rule.size(); i++)
   {
      directions[i].weight = rule[i].weight;
      SetProducts(rule[i].direction, directions[i].products);
   }
}

bool FiberDistribution::GetStress(const MaterialPoint &point,
                                  const Tensor3<> &F, Tensor3<> &stress,
                                  Tangent3 *tangent) const
{
   const Tensor3<> axes = frame.GetAxes(point);
   const Tensor3<> F_q = Product(F, axes);
   const Tensor3<> C = TransposedProduct(F_q, F_q);
   real_t strain[fourth] = {};
   for (int k = 0; k < 9; k++)
   {
      strain[PlaceOf(k / 3, k % 3)] += C[k / 3][k % 3];
   }
   const real_t threshold = Threshold();
   const int last = tangent ? moments : fourth;
   real_t sums[moments] = {};
   for (int i = 0; i < Directions(); i++)
   {
      const Direction &direction = directions[i];
      real_t square = 0.0;
      for (int k = 0; k < fourth; k++)
      {
         square += strain[k] * direction.products[k];
      }
      if (!IsTaut(threshold, square))
      {
         continue;
      }
      const FiberEnergy::Derivatives psi = Differentiate(i, square);
      const real_t tension = 2.0 * direction.weight * psi.first;
      const real_t stiffness = 4.0 * direction.weight * psi.second;
      for (int k = 0; k < fourth; k++)
      {
         sums[k] += tension * direction.products[k];
      }
      for (int k = fourth; k < last; k++)
      {
         sums[k] += stiffness * direction.products[k];
      }
   }
   Tensor3<> S{};
   for (int k = 0; k < 9; k++)
   {
      for (int a = 0; a < 3; a++)
      {
         for (int b = 0; b < 3; b++)
         {
            S[k / 3][k % 3] +=
               axes[k / 3][a] * sums[PlaceOf(a, b)] * axes[k % 3][b];
         }
      }
   }
   stress = Product(F, S);
   if (tangent)
   {
      SetTangent(sums, S, axes, F_q, *tangent);
   }
   return IsFinite(stress);
}

} // namespace synovia
