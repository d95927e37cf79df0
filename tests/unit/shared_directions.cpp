#include "synovia/linalg/shared_directions.hpp"
#include "synovia/general/reduce.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr int size_here = 6;
constexpr int right_sides = 3;

Vector RandomVector(int seed)
{
   Vector x(size_here);
   x.Randomize(100 * seed + Mpi::WorldRank() + 1);
   x -= 0.5;
   return x;
}

/// A matrix on this rank, unsymmetric.
DenseMatrix AnyMatrix()
{
   DenseMatrix a(size_here);
   for (int j = 0; j < size_here; j++)
   {
      a.SetCol(j, RandomVector(10 + j));
      a(j, j) += 2.0;
   }
   return a;
}

/// Half of the diagonal's inverse; counts how often it is asked.
class HalfDiagonal : public Operator
{
public:
   explicit HalfDiagonal(const DenseMatrix &a_) : Operator(a_.Height()), a(a_)
   {
   }
   void Mult(const Vector &x, Vector &y) const override
   {
      for (int i = 0; i < height; i++)
      {
         y[i] = 0.5 * x[i] / a(i, i);
      }
   }
   void ArrayMult(const Array<const Vector *> &x,
                  Array<Vector *> &y) const override
   {
      asked++;
      Operator::ArrayMult(x, y);
   }
   mutable int asked = 0;

private:
   const DenseMatrix &a;
};

real_t ResidualNorm(const DenseMatrix &a, const Vector &b, const Vector &x)
{
   Vector r(b);
   a.AddMult_a(-1.0, x, r);
   return std::sqrt(InnerProduct(MPI_COMM_WORLD, r, r));
}

std::vector<Vector> Zeros()
{
   Vector zero(size_here);
   zero = 0.0;
   return std::vector<Vector>(right_sides, zero);
}
} // namespace

TEST_CASE("Right sides that share directions are solved in fewer iterations")
{
   const DenseMatrix a = AnyMatrix();
   const HalfDiagonal preconditioner(a);
   SharedDirections solver(MPI_COMM_WORLD, a, preconditioner);
   std::vector<Vector> b;
   Vector targets(right_sides);
   for (int j = 0; j < right_sides; j++)
   {
      b.push_back(RandomVector(j));
      targets[j] = 1e-9 * std::sqrt(InnerProduct(MPI_COMM_WORLD, b[j], b[j]));
   }
   // As many directions as unknowns: nothing is left.
   const int unknowns = size_here * Mpi::WorldSize();
   std::vector<Vector> x = Zeros();
   Vector last(right_sides);
   last = infinity();
   for (int most = 0; most <= unknowns / right_sides; most++)
   {
      x = Zeros();
      solver.Solve(most, b, targets, x);
      for (int j = 0; j < right_sides; j++)
      {
         const real_t norm = ResidualNorm(a, b[j], x[j]);
         CHECK(norm <= (1.0 + 1e-12) * last[j]);
         last[j] = norm;
      }
   }
   for (int j = 0; j < right_sides; j++)
   {
      CHECK(last[j] <= targets[j]);
   }

   // From the solution on there is nothing to do.
   const int asked = preconditioner.asked;
   const std::vector<Vector> solution(x);
   solver.Solve(5, b, targets, x);
   CHECK(preconditioner.asked == asked);
   for (int j = 0; j < right_sides; j++)
   {
      x[j] -= solution[j];
      CHECK(x[j].Normlinf() == 0.0);
   }
}

TEST_CASE("Right sides that are alike make one direction")
{
   const DenseMatrix a = AnyMatrix();
   const HalfDiagonal preconditioner(a);
   SharedDirections solver(MPI_COMM_WORLD, a, preconditioner);
   Vector targets(right_sides);
   targets = 0.0;
   std::vector<Vector> b(right_sides, RandomVector(1));
   b[1] *= -3.0;
   b[2] = 0.0;
   std::vector<Vector> x = Zeros();
   solver.Solve(3, b, targets, x);
   std::vector<Vector> alone{x[0]};
   alone[0] = 0.0;
   Vector target(1);
   target = 0.0;
   solver.Solve(3, {b[0]}, target, alone);
   CHECK(alone[0].Normlinf() > 0.0);
   for (int j = 0; j < right_sides; j++)
   {
      x[j].Add(std::array<real_t, 3>{-1.0, 3.0, 0.0}[j], alone[0]);
      CHECK(x[j].Normlinf() <= 1e-12 * alone[0].Normlinf());
   }
}
