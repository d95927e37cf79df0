// Sums over ranks with a pattern that was found once, beside products with the
// matrices from local to true dofs.

#include "support/boxes.hpp"
#include "synovia/fem/local_matrix.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

using namespace mfem;
using namespace synovia;

namespace
{
real_t LargestDifference(const HypreParMatrix &a, const HypreParMatrix &b)
{
   Vector x(a.Width());
   Vector by_a(a.Height());
   Vector by_b(a.Height());
   x.Randomize(3);
   a.Mult(x, by_a);
   b.Mult(x, by_b);
   REQUIRE(by_a.Norml2() > 0.0);
   by_a -= by_b;
   return by_a.Normlinf();
}

void CheckSum(ParFiniteElementSpace &rows, ParFiniteElementSpace &columns)
{
   Sparsity sparsity(rows, columns);
   std::vector<real_t> entries(sparsity.Entries(), 0.0);
   SparseMatrix local(sparsity.Begins(), sparsity.Columns(), entries.data(),
                      rows.GetVSize(), columns.GetVSize(), false, false, false);
   SharedSum shared(rows, columns, local);
   std::unique_ptr<HypreParMatrix> before;
   for (int pass = 0; pass < 2; pass++)
   {
      Vector values(entries.data(), static_cast<int>(entries.size()));
      values.Randomize(1 + pass + 10 * rows.GetMyRank());
      const auto sum = shared.Sum(entries);
      const auto expected = SumShared(rows, columns, local);
      CHECK(sum->NNZ() == expected->NNZ());
      CHECK(LargestDifference(*sum, *expected) < 1e-13);
      if (before)
      {
         CHECK(LargestDifference(*sum, *before) > 1e-3);
      }
      before = shared.Sum(entries);
   }
}
} // namespace

TEST_CASE("Values are added in the places of the pattern, over all ranks")
{
   BoxOptions box;
   box.nx = 3;
   box.ny = 2;
   for (const auto type : {Element::HEXAHEDRON, Element::TETRAHEDRON})
   {
      box.type = type;
      NamedMesh mesh = MakeBox(box);
      for (const int order : {1, 2})
      {
         BiphasicSpaces spaces(mesh.Get(), order);
         ParFiniteElementSpace &u = spaces.Displacement();
         ParFiniteElementSpace &p = spaces.Pressure();
         if (u.GetNRanks() > 1)
         {
            const bool shares = u.GetVSize() > u.GetTrueVSize();
            REQUIRE(AnyRank(shares, spaces.GetComm()));
         }
         CheckSum(u, u);
         CheckSum(u, p);
         CheckSum(p, u);
         CheckSum(p, p);
      }
   }
}
