// ranks: 1 2 3 16
//
// Matrices that are assembled in the arrays of the distributed matrix, beside
// products of local ones with the matrices from local to true dofs.

#include "synovia/fem/assembled_matrix.hpp"
#include "support/boxes.hpp"
#include "support/shared_sum.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
real_t Largest(const Vector &x, MPI_Comm comm)
{
   return MaxOverRanks(x.Size() > 0 ? x.Normlinf() : 0.0, comm);
}

void CheckEqual(const HypreParMatrix &a, const HypreParMatrix &b)
{
   Vector x(a.Width());
   Vector by_a(a.Height());
   Vector by_b(a.Height());
   x.Randomize(3 + Mpi::WorldRank());
   a.Mult(x, by_a);
   b.Mult(x, by_b);
   // A rank may have no rows.
   const real_t size = Largest(by_b, b.GetComm());
   REQUIRE(size > 0.0);
   by_a -= by_b;
   CHECK(Largest(by_a, b.GetComm()) < 1e-13 * size);
}

BoxOptions Cells(Element::Type type)
{
   BoxOptions box;
   box.nx = 3;
   box.ny = 2;
   box.type = type;
   return box;
}

NamedMesh MakeCells(Element::Type type)
{
   return MakeBox(Cells(type));
}

/// All on each second rank.
NamedMesh MakeScatteredCells(Element::Type type)
{
   Mesh serial = MakeBoxMesh(Cells(type));
   const int filled = (Mpi::WorldSize() + 1) / 2;
   std::vector<int> owners(serial.GetNE());
   for (int i = 0; i < serial.GetNE(); i++)
   {
      owners[i] = 2 * (i % filled);
   }
   return DistributeMesh(serial, {{"body", {1}}}, {}, MPI_COMM_WORLD,
                         owners.data());
}

DenseMatrix RandomMatrix(int height, int width, int seed)
{
   DenseMatrix matrix(height, width);
   Vector entries(matrix.Data(), height * width);
   entries.Randomize(seed);
   return matrix;
}

/// Adds to both an assembled matrix and a local one, in turn as it is and
/// transposed.
class BothMatrices
{
public:
   BothMatrices(ParFiniteElementSpace &rows_, ParFiniteElementSpace &columns_)
      : rows(rows_), columns(columns_), assembled(rows, columns)
   {
      Clear();
   }

   void Clear()
   {
      assembled.Clear();
      local =
         std::make_unique<SparseMatrix>(rows.GetVSize(), columns.GetVSize());
   }

   void AddElements(int seed)
   {
      for (int e = 0; e < rows.GetNE(); e++)
      {
         rows.GetElementVDofs(e, row_dofs);
         columns.GetElementVDofs(e, column_dofs);
         AddToBoth(e, seed, e);
      }
   }

   void AddFaces(int seed)
   {
      for (int face = 0; face < rows.GetNBE(); face++)
      {
         rows.GetBdrElementVDofs(face, row_dofs);
         columns.GetBdrElementVDofs(face, column_dofs);
         AddToBoth(face, seed, row_dofs, column_dofs);
      }
   }

   void CheckSums()
   {
      local->Finalize(0);
      const auto sum = assembled.Sum();
      const auto expected = SumShared(rows, columns, *local);
      CHECK(sum->NNZ() == expected->NNZ());
      CheckEqual(*sum, *expected);
   }

private:
   /// Random entries by the dofs that were set, which the assembled matrix has
   /// at a place.
   template <typename... Place>
   void AddToBoth(int number, int seed, const Place &...place)
   {
      const DenseMatrix entries =
         RandomMatrix(row_dofs.Size(), column_dofs.Size(),
                      1 + number + 1000 * (seed + 10 * rows.GetMyRank()));
      if (number % 2 == 1)
      {
         DenseMatrix transposed;
         transposed.Transpose(entries);
         assembled.AddTransposed(place..., transposed);
      }
      else
      {
         assembled.Add(place..., entries);
      }
      local->AddSubMatrix(row_dofs, column_dofs, entries, 0);
   }

   ParFiniteElementSpace &rows;
   ParFiniteElementSpace &columns;
   AssembledMatrix assembled;
   std::unique_ptr<SparseMatrix> local;
   Array<int> row_dofs;
   Array<int> column_dofs;
};

void CheckAssembly(ParFiniteElementSpace &rows, ParFiniteElementSpace &columns)
{
   BothMatrices both(rows, columns);
   both.AddElements(1);
   both.AddFaces(2);
   both.CheckSums();
   both.Clear();
   both.AddElements(3);
   both.CheckSums();
}

void CheckAssemblies(BiphasicSpaces &spaces)
{
   ParFiniteElementSpace &u = spaces.Displacement();
   ParFiniteElementSpace &p = spaces.Pressure();
   CheckAssembly(u, u);
   CheckAssembly(u, p);
   CheckAssembly(p, u);
   CheckAssembly(p, p);
}
} // namespace

TEST_CASE("Elements' and faces' entries are added over all ranks")
{
   for (const auto type : {Element::HEXAHEDRON, Element::TETRAHEDRON})
   {
      NamedMesh mesh = MakeCells(type);
      for (const int order : {1, 2})
      {
         CAPTURE(type, order);
         BiphasicSpaces spaces(mesh.Get(), order);
         ParFiniteElementSpace &u = spaces.Displacement();
         if (u.GetNRanks() > 1)
         {
            const bool shares = u.GetVSize() > u.GetTrueVSize();
            REQUIRE(AnyRank(shares, spaces.GetComm()));
         }
         CheckAssemblies(spaces);
      }
   }
}

TEST_CASE("Ranks without elements add nothing")
{
   for (const auto type : {Element::HEXAHEDRON, Element::TETRAHEDRON})
   {
      CAPTURE(type);
      NamedMesh mesh = MakeScatteredCells(type);
      const bool has_none = Mpi::WorldRank() % 2 == 1;
      CHECK((mesh.Get().GetNE() == 0) == has_none);
      BiphasicSpaces spaces(mesh.Get(), 2);
      CheckAssemblies(spaces);
   }
}

TEST_CASE("Spaces with the same nodes share a pattern")
{
   NamedMesh mesh = MakeCells(Element::HEXAHEDRON);
   BiphasicSpaces spaces(mesh.Get(), 1);
   ParFiniteElementSpace &u = spaces.Displacement();
   ParFiniteElementSpace &p = spaces.Pressure();
   AssembledMatrix own(p, u);
   AssembledMatrix other(p, u, AssembledMatrix(u, u).Pattern());
   own.Clear();
   other.Clear();
   for (int e = 0; e < p.GetNE(); e++)
   {
      const DenseMatrix entries = RandomMatrix(8, 24, 1 + e);
      own.Add(e, entries);
      other.Add(e, entries);
   }
   const auto expected = own.Sum();
   const auto sum = other.Sum();
   CHECK(sum->NNZ() == expected->NNZ());
   CheckEqual(*sum, *expected);
}

TEST_CASE("A constant part is in all sums from then on")
{
   NamedMesh mesh = MakeCells(Element::HEXAHEDRON);
   BiphasicSpaces spaces(mesh.Get(), 1);
   ParFiniteElementSpace &u = spaces.Displacement();
   AssembledMatrix matrix(u, u);
   const auto add_all = [&](int seed)
   {
      for (int e = 0; e < u.GetNE(); e++)
      {
         DenseMatrix entries = RandomMatrix(24, 24, seed + e);
         // Single precision has sixteenths.
         for (real_t &entry : Vector(entries.Data(), 24 * 24))
         {
            entry = std::round(16.0 * entry) / 16.0;
         }
         matrix.Add(e, entries);
      }
   };
   matrix.Clear();
   add_all(1);
   add_all(1000);
   const auto expected = matrix.Sum();
   matrix.Clear();
   add_all(1);
   matrix.KeepAsConstant();
   for (int pass = 0; pass < 2; pass++)
   {
      matrix.Clear();
      add_all(1000);
      const auto sum = matrix.Sum();
      CheckEqual(*sum, *expected);
   }
}

TEST_CASE("Meshes that may have hanging nodes are refused")
{
   Mesh serial = MakeBoxMesh(Cells(Element::HEXAHEDRON));
   serial.EnsureNCMesh();
   ParMesh mesh(MPI_COMM_WORLD, serial);
   CHECK_THROWS_WITH(BiphasicSpaces(mesh, 1), Catch::Contains("hanging nodes"));
}
