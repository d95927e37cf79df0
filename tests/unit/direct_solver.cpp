// ranks: 1 2 3
//
// Factorizing one matrix after another, by each library that there is: the
// tests are also built without MUMPS, and without UMFPACK.

#include "synovia/linalg/direct_solver.hpp"
#include "synovia/general/parallel_triplets.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace mfem;
using namespace synovia;

namespace
{
/// (grad u, grad v) + factor (u, v) on a cube.
std::unique_ptr<HypreParMatrix> MakeMatrix(ParMesh &mesh, int order,
                                           real_t factor)
{
   const H1_FECollection elements(order, 3);
   ParFiniteElementSpace space(&mesh, &elements);
   ConstantCoefficient mass(factor);
   ParBilinearForm form(&space);
   form.AddDomainIntegrator(new DiffusionIntegrator);
   form.AddDomainIntegrator(new MassIntegrator(mass));
   form.Assemble();
   form.Finalize();
   return std::unique_ptr<HypreParMatrix>(form.ParallelAssemble());
}

Vector RightSide(int size, real_t phase = 1.0)
{
   Vector b(size);
   for (int i = 0; i < size; i++)
   {
      b[i] = std::sin(phase + 0.7 * i);
   }
   return b;
}

/// Norm of what is left, relative to that of the right side.
real_t Residual(const Solver &solver, const HypreParMatrix &matrix)
{
   const Vector b = RightSide(matrix.Height());
   Vector x(b.Size());
   solver.Mult(b, x);
   Vector left(b);
   matrix.Mult(-1.0, x, 1.0, left);
   return std::sqrt(InnerProduct(MPI_COMM_WORLD, left, left) /
                    InnerProduct(MPI_COMM_WORLD, b, b));
}

ParMesh Cube(int elements)
{
   Mesh cube = Mesh::MakeCartesian3D(elements, elements, elements + 1,
                                     Element::HEXAHEDRON);
   return ParMesh(MPI_COMM_WORLD, cube);
}

bool Works(DirectLibrary library)
{
   try
   {
      VerifyDirectLibrary(library, MPI_COMM_WORLD);
      return true;
   }
   catch (const Error &)
   {
      return false;
   }
}

/// At least one on any number of ranks, unless MUMPS is left out.
std::vector<DirectLibrary> Libraries()
{
   std::vector<DirectLibrary> libraries;
   for (const DirectLibrary library :
        {DirectLibrary::mumps, DirectLibrary::umfpack})
   {
      if (Works(library))
      {
         libraries.push_back(library);
      }
   }
   return libraries;
}

DirectOptions Options(DirectLibrary library, int memory_limit = 0)
{
   DirectOptions options;
   options.library = library;
   options.memory_limit = memory_limit;
   return options;
}

/// Factorizes @a first and then, with the same solver, each of @a others, by
/// each library and for each kind of matrix.
void CheckOneByOne(const HypreParMatrix &first,
                   const std::vector<const HypreParMatrix *> &others)
{
   std::size_t solved = 0;
   for (const DirectLibrary library : Libraries())
   {
      for (const MatrixKind kind : {MatrixKind::positive_definite,
                                    MatrixKind::symmetric, MatrixKind::general})
      {
         const std::unique_ptr<Solver> solver =
            MakeDirectSolver(first, kind, Options(library));
         CHECK(Residual(*solver, first) < 1e-12);
         for (const HypreParMatrix *matrix : others)
         {
            CAPTURE(matrix->NNZ());
            solver->SetOperator(*matrix);
            CHECK(Residual(*solver, *matrix) < 1e-12);
            solved++;
         }
      }
   }
   CHECK(solved == 3 * others.size() * Libraries().size());
}
} // namespace

TEST_CASE("The libraries say where they work")
{
#ifdef SYNOVIA_WITHOUT_MUMPS
   CHECK_THROWS_WITH(VerifyDirectLibrary(DirectLibrary::mumps, MPI_COMM_WORLD),
                     "this MFEM was built without MUMPS");
   const std::string others = "use an MFEM that has MUMPS";
#else
   CHECK(Works(DirectLibrary::mumps));
   CHECK(Works(DirectLibrary::automatic));
   const std::string others = "use MUMPS";
#endif
#ifdef SYNOVIA_WITHOUT_UMFPACK
   CHECK_THROWS_WITH(
      VerifyDirectLibrary(DirectLibrary::umfpack, MPI_COMM_WORLD),
      "this MFEM was built without UMFPACK (SuiteSparse)");
#else
   if (Mpi::WorldSize() == 1)
   {
      CHECK(Works(DirectLibrary::umfpack));
      CHECK(Works(DirectLibrary::automatic));
   }
   else
   {
      CHECK_THROWS_WITH(
         VerifyDirectLibrary(DirectLibrary::umfpack, MPI_COMM_WORLD),
         "UMFPACK works on one rank, and there are " +
            std::to_string(Mpi::WorldSize()) + ": run on one, or " + others);
   }
#endif
}

TEST_CASE("A direct solver takes matrices with the same entries and others")
{
   ParMesh mesh = Cube(3);
   const std::unique_ptr<HypreParMatrix> first = MakeMatrix(mesh, 1, 1.0);
   REQUIRE(first->Height() > 0);
   // The same places, then others, then those of the beginning.
   const std::unique_ptr<HypreParMatrix> same = MakeMatrix(mesh, 1, 100.0);
   const std::unique_ptr<HypreParMatrix> larger = MakeMatrix(mesh, 2, 1.0);
   const std::unique_ptr<HypreParMatrix> last = MakeMatrix(mesh, 1, 5.0);
   CheckOneByOne(*first, {same.get(), larger.get(), last.get()});
}

TEST_CASE("A direct solver takes matrices of one size with other entries")
{
   ParMesh mesh = Cube(5);
   const std::unique_ptr<HypreParMatrix> first = MakeMatrix(mesh, 1, 100.0);
   REQUIRE(first->Height() > 0);
   // A few couplings more, as contact has where it slides, and many more.
   const HYPRE_BigInt rows = first->GetGlobalNumRows();
   std::vector<Triplet> links;
   for (HYPRE_BigInt i = first->RowPart()[0]; i < first->RowPart()[1]; i += 20)
   {
      const HYPRE_BigInt other = (i + rows / 2) % rows;
      links.push_back({i, other, 1e-4});
      links.push_back({other, i, 1e-4});
   }
   const auto linked = AssembleTriplets(MPI_COMM_WORLD, links, first->RowPart(),
                                        rows, first->RowPart(), rows);
   const std::unique_ptr<HypreParMatrix> few(Add(1.0, *first, 1.0, *linked));
   const std::unique_ptr<HypreParMatrix> many(
      ParMult(first.get(), first.get(), true));
   REQUIRE(few->NNZ() > first->NNZ());
   REQUIRE(many->NNZ() > 2 * first->NNZ());
   CheckOneByOne(*first, {few.get(), many.get(), first.get()});
}

TEST_CASE("A direct solver takes unknowns that nothing acts on, however many")
{
   ParMesh mesh = Cube(4);
   const std::unique_ptr<HypreParMatrix> first = MakeMatrix(mesh, 1, 1.0);
   REQUIRE(first->Height() > 0);
   // Those with these remainders, as some that are held and others that are
   // held next, and all; then all but those of the last rank.
   const std::vector<std::vector<int>> held{{0}, {1, 2}, {1}, {0, 1, 2}};
   std::vector<std::unique_ptr<HypreParMatrix>> others;
   std::vector<const HypreParMatrix *> borrowed;
   const auto add = [&](const Array<int> &dofs)
   {
      others.push_back(std::make_unique<HypreParMatrix>(*first));
      others.back()->EliminateBC(dofs, Operator::DIAG_KEEP);
      borrowed.push_back(others.back().get());
   };
   for (const std::vector<int> &remainders : held)
   {
      Array<int> dofs;
      for (int i = 0; i < first->Height(); i++)
      {
         if (std::count(remainders.begin(), remainders.end(), i % 3) > 0)
         {
            dofs.Append(i);
         }
      }
      add(dofs);
   }
   Array<int> all_but_last;
   for (int i = 0;
        Mpi::WorldRank() + 1 < Mpi::WorldSize() && i < first->Height(); i++)
   {
      all_but_last.Append(i);
   }
   add(all_but_last);
   CheckOneByOne(*first, borrowed);
}

TEST_CASE("Factors in single precision are a preconditioner")
{
   ParMesh mesh = Cube(4);
   const auto matrix = MakeMatrix(mesh, 2, 1.0);
   const auto check = [&](DirectLibrary library, MatrixKind kind)
   {
      DirectOptions options = Options(library);
      options.single_precision = true;
      const std::unique_ptr<Solver> solver =
         MakeDirectSolver(*matrix, kind, options);
      const real_t residual = Residual(*solver, *matrix);
      CHECK(residual < 1e-5);
#ifdef SYNOVIA_HAS_SINGLE_MUMPS
      CHECK((residual > 1e-9) == (library == DirectLibrary::mumps));
#endif
      // Again, with other values at the same places.
      const auto other = MakeMatrix(mesh, 2, 100.0);
      solver->SetOperator(*other);
      CHECK(Residual(*solver, *other) < 1e-5);
   };
   for (const DirectLibrary library : Libraries())
   {
      check(library, MatrixKind::general);
      check(library, MatrixKind::symmetric);
   }
}

TEST_CASE("The libraries come to the same solution")
{
   if (Libraries().size() < 2)
   {
      return;
   }
   ParMesh mesh = Cube(4);
   // Indefinite.
   const auto matrix = MakeMatrix(mesh, 2, -290.0);
   const Vector b = RightSide(matrix->Height());
   Vector by_mumps(b.Size());
   Vector by_umfpack(b.Size());
   MakeDirectSolver(*matrix, MatrixKind::symmetric,
                    Options(DirectLibrary::mumps))
      ->Mult(b, by_mumps);
   MakeDirectSolver(*matrix, MatrixKind::symmetric,
                    Options(DirectLibrary::umfpack))
      ->Mult(b, by_umfpack);
   REQUIRE(by_mumps.Norml2() > 0.0);
   by_umfpack -= by_mumps;
   CHECK(by_umfpack.Norml2() < 1e-10 * by_mumps.Norml2());
}

TEST_CASE("Several right sides are solved for as each alone")
{
   ParMesh mesh = Cube(3);
   const auto matrix = MakeMatrix(mesh, 2, 1.0);
   for (const DirectLibrary library : Libraries())
   {
      const std::unique_ptr<Solver> solver =
         MakeDirectSolver(*matrix, MatrixKind::symmetric, Options(library));
      std::vector<Vector> right_sides;
      std::vector<Vector> solutions(3, Vector(matrix->Height()));
      Array<const Vector *> x;
      Array<Vector *> y;
      right_sides.reserve(3);
      for (int i = 0; i < 3; i++)
      {
         right_sides.push_back(RightSide(matrix->Height(), i));
         x.Append(&right_sides[i]);
         y.Append(&solutions[i]);
      }
      solver->ArrayMult(x, y);
      for (int i = 0; i < 3; i++)
      {
         Vector alone(matrix->Height());
         solver->Mult(right_sides[i], alone);
         REQUIRE(alone.Norml2() > 0.0);
         alone -= solutions[i];
         CHECK(alone.Norml2() < 1e-12 * solutions[i].Norml2());
      }
   }
}

TEST_CASE("A factorization that needs more memory than it may have fails")
{
   ParMesh coarse = Cube(2);
   ParMesh fine = Cube(8);
   const auto small = MakeMatrix(coarse, 1, 1.0);
   const auto large = MakeMatrix(fine, 2, 1.0);
   constexpr int little = 4;
   int failed = 0;
   for (const DirectLibrary library : Libraries())
   {
      const std::unique_ptr<Solver> solver = MakeDirectSolver(
         *small, MatrixKind::symmetric, Options(library, little));
      CHECK(Residual(*solver, *small) < 1e-12);
      for (int repetition = 0; repetition < 2; repetition++)
      {
         try
         {
            solver->SetOperator(*large);
         }
         catch (const FactorizationError &error)
         {
            failed++;
            CHECK_THAT(
               error.what(),
               Catch::Contains("could not factorize the matrix (5491 "
                               "unknowns): it") &&
                  Catch::Contains(
                     " MB more than direct_memory_limit (4 MB) allows"));
         }
      }
      // It is as good as new.
      solver->SetOperator(*small);
      CHECK(Residual(*solver, *small) < 1e-12);

      const std::unique_ptr<Solver> enough = MakeDirectSolver(
         *large, MatrixKind::symmetric, Options(library, 1000));
      CHECK(Residual(*enough, *large) < 1e-12);
   }
   CHECK(failed == 2 * static_cast<int>(Libraries().size()));
}

TEST_CASE("A singular matrix is said to be one")
{
   ParMesh mesh = Cube(3);
   const auto good = MakeMatrix(mesh, 1, 1.0);
   const auto singular = MakeMatrix(mesh, 1, 1.0);
   // A row and a column of zeros.
   Array<int> dofs;
   if (Mpi::WorldRank() == 0)
   {
      dofs.Append(0);
   }
   singular->EliminateBC(dofs, Operator::DIAG_ZERO);
   for (const DirectLibrary library : Libraries())
   {
      CHECK_THROWS_WITH(
         MakeDirectSolver(*singular, MatrixKind::symmetric, Options(library)),
         Catch::EndsWith("the matrix is singular"));
      const std::unique_ptr<Solver> solver =
         MakeDirectSolver(*good, MatrixKind::symmetric, Options(library));
      CHECK_THROWS_AS(solver->SetOperator(*singular), FactorizationError);
      solver->SetOperator(*good);
      CHECK(Residual(*solver, *good) < 1e-12);
   }
}
