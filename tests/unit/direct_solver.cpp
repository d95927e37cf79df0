// ranks: 1 2 3
//
// Factorising one matrix after another in the same solver.

#include "solvers/direct_solver.hpp"

#include <catch2/catch.hpp>

#include <cmath>

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

/// Norm of what is left, relative to that of the right side.
real_t Residual(const Solver &solver, const HypreParMatrix &matrix)
{
   Vector b(matrix.Height());
   for (int i = 0; i < b.Size(); i++)
   {
      b[i] = std::sin(1.0 + 0.7 * i);
   }
   Vector x(b.Size());
   solver.Mult(b, x);
   Vector left(b);
   matrix.Mult(-1.0, x, 1.0, left);
   return std::sqrt(InnerProduct(MPI_COMM_WORLD, left, left) /
                    InnerProduct(MPI_COMM_WORLD, b, b));
}
} // namespace

TEST_CASE("A direct solver takes matrices with the same entries and others")
{
   Mesh cube = Mesh::MakeCartesian3D(3, 3, 4, Element::HEXAHEDRON);
   ParMesh mesh(MPI_COMM_WORLD, cube);
   const auto first = MakeMatrix(mesh, 1, 1.0);
   REQUIRE(first->Height() > 0);
   for (const MatrixKind kind :
        {MatrixKind::positive_definite, MatrixKind::symmetric})
   {
      const std::unique_ptr<Solver> solver = MakeDirectSolver(*first, kind);
      CHECK(Residual(*solver, *first) < 1e-12);
      // The same places, then others, then those of the beginning.
      for (const auto &[order, factor] :
           {std::pair<int, real_t>{1, 100.0}, {2, 1.0}, {1, 5.0}})
      {
         CAPTURE(order, factor);
         const auto matrix = MakeMatrix(mesh, order, factor);
         solver->SetOperator(*matrix);
         CHECK(Residual(*solver, *matrix) < 1e-12);
      }
   }
}
