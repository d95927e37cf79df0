#include "synovia/fem/null_space.hpp"

#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
// Gauss-Jordan; the largest pivot is on the diagonal of the remaining matrix.
// Replaces rows of pivots by the reduced ones.
Array<int> Eliminate(DenseMatrix &rows, real_t tolerance)
{
   const int size = rows.Height();
   Array<int> pivots;
   Array<bool> used(size);
   used = false;
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
      if (!(rows(best, best) > tolerance))
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
   return pivots;
}
} // namespace

Array<int> IndependentColumns(DenseMatrix a, real_t tolerance)
{
   return Eliminate(a, tolerance);
}

std::vector<Vector> NullSpace(DenseMatrix a, real_t tolerance)
{
   const Array<int> pivots = Eliminate(a, tolerance);
   std::vector<Vector> free;
   for (int f = 0; f < a.Height(); f++)
   {
      if (pivots.Find(f) < 0)
      {
         free.emplace_back(a.Height());
         Vector &x = free.back();
         x = 0.0;
         x[f] = 1.0;
         for (const int pivot : pivots)
         {
            x[pivot] = -a(pivot, f);
         }
         x /= x.Normlinf();
      }
   }
   return free;
}

} // namespace synovia
