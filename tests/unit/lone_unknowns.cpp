// ranks: 1 2 3
//
// Which unknowns of a distributed matrix act on nothing, and how the others are
// numbered without them.

#include "synovia/linalg/lone_unknowns.hpp"

#include <catch2/catch.hpp>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr int rows_of_rank = 5;

/// Rows of a rank: the first one acts on the third of the rank before, the
/// fourth has a zero beside its diagonal, and that of the fifth is zero.
SparseMatrix MakeRows(int rank, int ranks)
{
   const int size = rows_of_rank * ranks;
   const int first = rows_of_rank * rank;
   SparseMatrix rows(rows_of_rank, size);
   for (int i = 0; i < rows_of_rank; i++)
   {
      rows.Set(i, first + i, i == 4 ? 0.0 : 2.0 + i);
   }
   const int previous = (first + size - rows_of_rank + 2) % size;
   rows.Set(0, previous, 0.5);
   rows.Set(3, first, 0.0);
   rows.Finalize(0);
   return rows;
}
} // namespace

TEST_CASE("Lone unknowns are those that act on none and that none acts on")
{
   int rank = 0;
   int ranks = 1;
   MPI_Comm_rank(MPI_COMM_WORLD, &rank);
   MPI_Comm_size(MPI_COMM_WORLD, &ranks);
   const SparseMatrix rows = MakeRows(rank, ranks);
   const LoneUnknowns lone(rows, rows_of_rank * rank, MPI_COMM_WORLD);
   std::vector<int> expected;
   std::vector<int> others;
   for (int i = 0; i < rows_of_rank * ranks; i++)
   {
      const int place = i % rows_of_rank;
      const bool is_lone = place == 1 || place == 3;
      CAPTURE(i);
      CHECK(lone.Has(i) == is_lone);
      if (is_lone)
      {
         expected.push_back(i);
      }
      else
      {
         CHECK(lone.NumberOfOther(i) == static_cast<int>(others.size()));
         others.push_back(i);
      }
   }
   CHECK(lone.Rows() == expected);
   CHECK(lone.Others(rows_of_rank * ranks) == others);
}
