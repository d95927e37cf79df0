// ranks: 1 2 3
//
// Exact solves whose penalties change: by a factorization, or by columns.

#include "synovia/linalg/penalized_solver.hpp"
#include "synovia/linalg/injection.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <vector>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr int most_columns = 8;
constexpr real_t penalty = 1e3;

/// A = (grad u, grad v) + (u, v) on a cube. The rows of F, every fifth of this
/// rank's, are A's, and those of R have half the diffusion.
struct Penalized
{
   explicit Penalized(bool symmetric)
      : cube(Mesh::MakeCartesian3D(6, 6, 7, Element::HEXAHEDRON)),
        mesh(MPI_COMM_WORLD, cube), elements(1, 3), space(&mesh, &elements),
        matrix(Assemble(1.0)),
        solver(symmetric ? MatrixKind::positive_definite : MatrixKind::general,
               DirectOptions(), most_columns)
   {
      Array<int> rows;
      for (int i = 0; i < matrix->Height(); i += 5)
      {
         rows.Append(i);
      }
      REQUIRE(rows.Size() > most_columns);
      forces = Rows(*matrix, rows);
      changes = Rows(*Assemble(symmetric ? 1.0 : 0.5), rows);
      weights.emplace_back(rows.Size());
      weights[0] = 0.0;
      for (int j = 0; j < rows.Size(); j += 2)
      {
         weights[0][j] = penalty;
      }
      std::vector<PenalizedSolver::Factor> factors(1);
      factors[0].forces = std::make_unique<HypreParMatrix>(*forces);
      if (!symmetric)
      {
         factors[0].changes = std::make_unique<HypreParMatrix>(*changes);
      }
      solver.SetMatrices(std::make_unique<HypreParMatrix>(*matrix),
                         std::move(factors));
      solver.SetHeld(Array<int>());
      solver.SetWeights(weights, work);
   }

   std::unique_ptr<HypreParMatrix> Assemble(real_t diffusion)
   {
      ConstantCoefficient factor(diffusion);
      ParBilinearForm form(&space);
      form.AddDomainIntegrator(new DiffusionIntegrator(factor));
      form.AddDomainIntegrator(new MassIntegrator);
      form.Assemble();
      form.Finalize();
      return std::unique_ptr<HypreParMatrix>(form.ParallelAssemble());
   }

   static std::unique_ptr<HypreParMatrix> Rows(const HypreParMatrix &from,
                                               const Array<int> &rows)
   {
      const std::unique_ptr<HypreParMatrix> picks(
         Injection(from, rows)->Transpose());
      return std::unique_ptr<HypreParMatrix>(ParMult(picks.get(), &from, true));
   }

   /// Lets rows of this rank touch that don't, and leave that do.
   void Toggle(int begin, int end)
   {
      for (int j = begin; j < end; j++)
      {
         weights[0][j] = penalty - weights[0][j];
      }
      solver.SetWeights(weights, work);
   }

   /// Norm of b - (A + F^T W R) x, with the held dofs' b, relative to b's.
   real_t Residual(const Array<int> &held = Array<int>()) const
   {
      Vector b(matrix->Height());
      for (int i = 0; i < b.Size(); i++)
      {
         b[i] = std::sin(1.0 + 0.7 * i);
      }
      Vector x(b.Size());
      solver.Mult(b, x);
      for (const int dof : held)
      {
         CHECK(x[dof] == 0.0);
      }
      Vector left(b);
      matrix->Mult(-1.0, x, 1.0, left);
      Vector rows(changes->Height());
      changes->Mult(x, rows);
      rows *= weights[0];
      forces->MultTranspose(-1.0, rows, 1.0, left);
      left.SetSubVector(held, 0.0);
      return std::sqrt(InnerProduct(MPI_COMM_WORLD, left, left) /
                       InnerProduct(MPI_COMM_WORLD, b, b));
   }

   static int Ranks()
   {
      int ranks = 1;
      MPI_Comm_size(MPI_COMM_WORLD, &ranks);
      return ranks;
   }

   Mesh cube;
   ParMesh mesh;
   H1_FECollection elements;
   ParFiniteElementSpace space;
   std::unique_ptr<HypreParMatrix> matrix;
   std::unique_ptr<HypreParMatrix> forces;
   std::unique_ptr<HypreParMatrix> changes;
   std::vector<Vector> weights;
   PenalizedSolver solver;
   WorkCounts work;
};

constexpr real_t round_off = 1e-9;
} // namespace

TEST_CASE("A few changed penalties make columns, once each")
{
   Penalized system(GENERATE(true, false));
   CHECK(system.Residual() < round_off);
   const int two_each = 2 * Penalized::Ranks();
   // One row comes and one goes.
   system.Toggle(0, 2);
   CHECK(system.work.factorizations == 1);
   CHECK(system.work.columns == two_each);
   CHECK(system.Residual() < round_off);
   system.Toggle(0, 1);
   system.Toggle(0, 1);
   CHECK(system.work.factorizations == 1);
   CHECK(system.work.columns == two_each);
   CHECK(system.Residual() < round_off);
}

TEST_CASE("Many changed penalties make a factorization")
{
   Penalized system(GENERATE(true, false));
   const int rows = system.weights[0].Size();
   system.Toggle(0, rows);
   CHECK(system.work.factorizations == 2);
   CHECK(system.work.columns == 0);
   CHECK(system.Residual() < round_off);
   // So do many one after another.
   for (int j = 0; j <= most_columns; j++)
   {
      system.Toggle(j, j + 1);
      CHECK(system.Residual() < round_off);
   }
   CHECK(system.work.factorizations > 2);
   CHECK(system.work.columns <=
         most_columns * (system.work.factorizations - 1));
}

TEST_CASE("Held dofs are zero, and other ones make a factorization")
{
   Penalized system(GENERATE(true, false));
   const Array<int> held({0, 5, 6});
   system.solver.SetHeld(held);
   system.Toggle(0, 0);
   CHECK(system.work.factorizations == 2);
   CHECK(system.Residual(held) < round_off);
   system.solver.SetHeld(held);
   system.Toggle(0, 2);
   CHECK(system.work.factorizations == 2);
   CHECK(system.work.columns == 2 * Penalized::Ranks());
   CHECK(system.Residual(held) < round_off);
}

TEST_CASE("A solver that is no good gives up its columns, and then no more")
{
   Penalized system(true);
   CHECK_FALSE(system.solver.Improve());
   // As it was factorized.
   system.Toggle(0, 0);
   CHECK_FALSE(system.solver.Improve());
   system.Toggle(0, 1);
   REQUIRE(system.work.columns == Penalized::Ranks());
   REQUIRE(system.solver.Improve());
   system.Toggle(0, 0);
   CHECK(system.work.factorizations == 2);
   CHECK(system.Residual() < round_off);
   CHECK_FALSE(system.solver.Improve());
}
