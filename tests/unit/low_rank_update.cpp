// ranks: 1 2 3
//
// Solving with a changed matrix by way of the unchanged one.

#include "synovia/linalg/low_rank_update.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
// Entry of a distributed vector, the same whatever the number of ranks.
Vector Distributed(int global, int seed)
{
   int rank = 0;
   int ranks = 1;
   MPI_Comm_rank(MPI_COMM_WORLD, &rank);
   MPI_Comm_size(MPI_COMM_WORLD, &ranks);
   const int begin = global * rank / ranks;
   const int end = global * (rank + 1) / ranks;
   Vector x(end - begin);
   for (int i = 0; i < x.Size(); i++)
   {
      x[i] = std::sin(1.0 + seed + 0.7 * (begin + i) * (seed + 1));
   }
   return x;
}

// A is a diagonal matrix.
Vector Divide(const Vector &x, const Vector &diagonal)
{
   Vector y(x);
   y /= diagonal;
   return y;
}

// Every other entry, from @a first.
SparsePart Sparse(const Vector &x, int first)
{
   SparsePart part;
   for (int k = first; k < x.Size(); k += 2)
   {
      part.Add(k, x[k]);
   }
   return part;
}

real_t DistanceOf(const Vector &x, const Vector &y)
{
   Vector difference(x);
   difference -= y;
   return std::sqrt(InnerProduct(MPI_COMM_WORLD, difference, difference));
}
} // namespace

TEST_CASE("A matrix changed by low rank is solved by way of the unchanged one")
{
   constexpr int size = 50;
   constexpr int rank = 3;
   const bool symmetric = GENERATE(true, false);
   CAPTURE(symmetric);
   Vector diagonal = Distributed(size, 7);
   for (int i = 0; i < diagonal.Size(); i++)
   {
      diagonal[i] = 2.0 + diagonal[i];
   }
   std::vector<LowRankUpdate::Column> columns(rank);
   std::vector<const LowRankUpdate::Column *> borrowed;
   for (int i = 0; i < rank; i++)
   {
      columns[i].left = Sparse(Distributed(size, i), i);
      columns[i].right =
         symmetric ? columns[i].left : Sparse(Distributed(size, 10 + i), 0);
      columns[i].z = Divide(columns[i].left.Dense(diagonal.Size()), diagonal);
      borrowed.push_back(&columns[i]);
   }
   // Indefinite, and far from A.
   Vector k(rank);
   k[0] = 1e6;
   k[1] = -3.0;
   k[2] = 1e-3;
   LowRankUpdate update(MPI_COMM_WORLD);
   update.Set(borrowed, k);

   const Vector exact = Distributed(size, 20);
   Vector right_side(exact);
   right_side *= diagonal;
   for (int i = 0; i < rank; i++)
   {
      const Vector left = columns[i].left.Dense(exact.Size());
      const Vector right = columns[i].right.Dense(exact.Size());
      right_side.Add(k[i] * InnerProduct(MPI_COMM_WORLD, right, exact), left);
   }
   Vector solution = Divide(right_side, diagonal);
   REQUIRE(DistanceOf(solution, exact) > 1.0);
   update.Correct(solution);
   CHECK(DistanceOf(solution, exact) < 1e-8);

   update.Set({}, Vector());
   Vector as_it_is = Divide(right_side, diagonal);
   const Vector before(as_it_is);
   update.Correct(as_it_is);
   CHECK(DistanceOf(as_it_is, before) == 0.0);
}
