#include "synovia/fem/null_space.hpp"

#include <cmath>

namespace synovia
{

using namespace mfem;

std::vector<Vector> NullSpace(const DenseMatrix &a)
{
   // Of the largest pivot: below this it is round-off.
   constexpr real_t nothing = 1e-9;
   DenseMatrix rows(a);
   const int size = rows.Height();
   // Gauss-Jordan; the largest pivot is on the diagonal of what is left.
   Array<int> pivots;
   Array<bool> used(size);
   used = false;
   real_t first = 0.0;
   while (pivots.Size() < size)
   {
      int best = -1;
      for (int i = 0; i < size; i++)
      {
         if (!used[i] && (best < 0 || rows(i, i) > rows(best, best)))
         {
            best = i;
         }
      }
      first = pivots.Size() == 0 ? rows(best, best) : first;
      if (!(rows(best, best) > nothing * first))
      {
         break;
      }
      used[best] = true;
      pivots.Append(best);
      const real_t pivot = rows(best, best);
      for (int j = 0; j < size; j++)
      {
         rows(best, j) /= pivot;
      }
      for (int i = 0; i < size; i++)
      {
         const real_t factor = rows(i, best);
         for (int j = 0; i != best && j < size; j++)
         {
            rows(i, j) -= factor * rows(best, j);
         }
      }
   }
   std::vector<Vector> free;
   for (int f = 0; f < size; f++)
   {
      if (!used[f])
      {
         free.emplace_back(size);
         Vector &x = free.back();
         x = 0.0;
         x[f] = 1.0;
         for (const int pivot : pivots)
         {
            x[pivot] = -rows(pivot, f);
         }
         x /= x.Normlinf();
      }
   }
   return free;
}

} // namespace synovia
