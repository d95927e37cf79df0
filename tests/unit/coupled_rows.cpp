// ranks: 1 2 3
//
// What a factorization takes of a distributed matrix: the zeros of unknowns
// that nothing acts on, or all of them, are left out, and nothing else.

#include "synovia/linalg/coupled_rows.hpp"
#include "synovia/general/parallel_triplets.hpp"

#include <catch2/catch.hpp>

#include <set>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr int rows_of_rank = 4;

/// A ring of unknowns that act on both neighbors, with zeros for those after
/// them, but for the second of each rank, which is prescribed, and the last,
/// which has a zero on the diagonal.
struct Ring
{
   Ring()
   {
      MPI_Comm_rank(MPI_COMM_WORLD, &rank);
      MPI_Comm_size(MPI_COMM_WORLD, &ranks);
      size = rows_of_rank * ranks;
      std::vector<Triplet> triplets;
      for (int i = First(); i < First() + rows_of_rank; i++)
      {
         triplets.push_back({i, i, IsLast(i) ? 0.0 : 4.0});
         for (const int j : {Next(i, 1), Next(i, -1), Next(i, 2), Next(i, -2)})
         {
            const bool acts = j == Next(i, 1) || j == Next(i, -1);
            const bool free = !IsPrescribed(i) && !IsPrescribed(j);
            triplets.push_back({i, j, acts && free ? -1.0 : 0.0});
         }
      }
      HYPRE_BigInt part[2] = {First(), First() + rows_of_rank};
      matrix =
         AssembleTriplets(MPI_COMM_WORLD, triplets, part, size, part, size);
   }
   int First() const { return rows_of_rank * rank; }
   int Next(int i, int by) const { return (i + by + size) % size; }
   static bool IsPrescribed(int i) { return i % rows_of_rank == 1; }
   static bool IsLast(int i) { return i % rows_of_rank == rows_of_rank - 1; }

   /// Columns that a row should have.
   std::set<int> Expected(int i, DroppedZeros dropped) const
   {
      std::set<int> columns{i};
      const bool all = dropped == DroppedZeros::all;
      for (const int j : {Next(i, 1), Next(i, -1), Next(i, 2), Next(i, -2)})
      {
         const bool acts = j == Next(i, 1) || j == Next(i, -1);
         if (!IsPrescribed(i) && !IsPrescribed(j) && (acts || !all))
         {
            columns.insert(j);
         }
      }
      return columns;
   }

   int rank = 0;
   int ranks = 1;
   int size = 0;
   std::unique_ptr<HypreParMatrix> matrix;
};
} // namespace

TEST_CASE("Zeros of lone unknowns, or all, are no entries")
{
   const DroppedZeros dropped =
      GENERATE(DroppedZeros::of_lone_unknowns, DroppedZeros::all);
   const Ring ring;
   const CoupledMatrix coupled = CoupledRows(*ring.matrix, dropped);
   const SparseMatrix &rows = coupled.rows;
   REQUIRE(rows.Height() == rows_of_rank);
   for (int i = 0; i < rows_of_rank; i++)
   {
      CAPTURE(i);
      const int row = ring.First() + i;
      std::set<int> columns;
      for (int k = rows.GetI()[i]; k < rows.GetI()[i + 1]; k++)
      {
         const int column = rows.GetJ()[k];
         CHECK(columns.insert(column).second);
         if (column == row)
         {
            CHECK(rows.GetData()[k] == (Ring::IsLast(row) ? 0.0 : 4.0));
         }
      }
      CHECK(columns == ring.Expected(row, dropped));
   }
}
