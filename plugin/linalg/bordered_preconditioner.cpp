#include "synovia/linalg/bordered_preconditioner.hpp"
#include "synovia/general/vector_entries.hpp"
#include "synovia/linalg/scaled_equations.hpp"
#include "synovia/linalg/shared_directions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace synovia
{

using namespace mfem;

namespace
{
/// The equations with the slots held.
class HeldEquations : public Operator
{
public:
   explicit HeldEquations(const BiphasicJacobian &jacobian_)
      : Operator(jacobian_.Height()), jacobian(jacobian_),
        ties(jacobian.Ties()->Ties()), none(ties.Slots().size())
   {
      none = 0.0;
   }
   void Mult(const Vector &x, Vector &y) const override
   {
      const Vector held = ties.Gather(x);
      free = x;
      ties.Scatter(none, free);
      jacobian.Mult(free, y);
      ties.Scatter(held, y);
   }

private:
   const BiphasicJacobian &jacobian;
   const RigidTies &ties;
   Vector none;
   mutable Vector free;
};

/// Solvers for them, scaled, with the preconditioner of all else.
class HeldSystem
{
public:
   HeldSystem(const BiphasicJacobian &jacobian, MPI_Comm comm_,
              BiphasicPreconditioner &inner_, real_t force_per_volume)
      : comm(comm_), inner(inner_), held(jacobian),
        scaled(held, jacobian.Offsets()[1], force_per_volume),
        scaled_inner(inner, jacobian.Offsets()[1], 1.0 / force_per_volume),
        solver(comm)
   {
      solver.SetPrintLevel(IterativeSolver::PrintLevel().None());
      solver.SetOperator(scaled);
      solver.SetPreconditioner(scaled_inner);
   }
   /// From the x that is given.
   SolveAttempt Iterate(int most_iterations, const Vector &b, real_t target,
                        Vector &x)
   {
      solver.SetKDim(most_iterations);
      solver.iterative_mode = true;
      return Attempt(inner, most_iterations, b, target, solver, x);
   }
   void IterateTogether(int most_iterations, const std::vector<Vector> &b,
                        const Vector &targets, std::vector<Vector> &x)
   {
      SharedDirections(comm, scaled, scaled_inner)
         .Solve(most_iterations, b, targets, x);
   }

private:
   MPI_Comm comm;
   BiphasicPreconditioner &inner;
   HeldEquations held;
   ScaledOperator2x2 scaled;
   ScaledSolver scaled_inner;
   FGMRESSolver solver;
};
} // namespace

BorderedPreconditioner::BorderedPreconditioner(
   const BiphasicJacobian &jacobian_, MPI_Comm comm_, real_t force_per_volume_,
   std::unique_ptr<BiphasicPreconditioner> inner_)
   : BiphasicPreconditioner(jacobian_.Height()), jacobian(jacobian_),
     comm(comm_), force_per_volume(force_per_volume_), inner(std::move(inner_)),
     columns(Ties().Slots().size())
{
   for (Vector &column : columns)
   {
      column.SetSize(height);
      column = 0.0;
   }
}

void BorderedPreconditioner::Hold(Vector &x) const
{
   Vector none(Columns());
   none = 0.0;
   Ties().Scatter(none, x);
}

void BorderedPreconditioner::Update()
{
   inner->Update();
   if (columns.empty())
   {
      work = inner->Work();
      return;
   }
   fresh = outdated;
   if (outdated)
   {
      SolveColumns();
   }
   if (!Project() && !fresh)
   {
      ImproveColumns();
      Project();
   }
   work = inner->Work();
   work.columns += columns_solved;
}

Vector BorderedPreconditioner::Unit(int freedom) const
{
   Vector amounts(Columns());
   amounts = 0.0;
   amounts[freedom] = 1.0;
   Vector unit(height);
   unit = 0.0;
   Ties().Scatter(amounts, unit);
   return unit;
}

void BorderedPreconditioner::KeepOthers(Vector &forces) const
{
   Hold(forces);
   ScaleFrom(jacobian.Offsets()[1], force_per_volume, forces);
}

real_t BorderedPreconditioner::NormOnOthers(Vector forces) const
{
   KeepOthers(forces);
   return std::sqrt(InnerProduct(comm, forces, forces));
}

void BorderedPreconditioner::ChangeColumns(const ColumnSolver &solve)
{
   // Good enough for what the columns take to be what the freedoms need.
   constexpr real_t accuracy = 1e-2;
   const int pressure_begin = jacobian.Offsets()[1];
   std::vector<Vector> forces(columns.size(), Vector(height));
   Vector targets(Columns());
   for (int j = 0; j < Columns(); j++)
   {
      jacobian.Mult(Unit(j), forces[j]);
      KeepOthers(forces[j]);
      forces[j].Neg();
      targets[j] =
         accuracy * std::sqrt(InnerProduct(comm, forces[j], forces[j]));
      Hold(columns[j]);
      ScaleFrom(pressure_begin, 1.0 / force_per_volume, columns[j]);
   }
   solve(forces, targets, columns);
   for (int j = 0; j < Columns(); j++)
   {
      ScaleFrom(pressure_begin, force_per_volume, columns[j]);
      columns[j].HostReadWrite();
      columns[j] += Unit(j);
   }
   columns_solved += Columns();
   outdated = false;
}

void BorderedPreconditioner::SolveColumns()
{
   constexpr int most_iterations = 200;
   HeldSystem system(jacobian, comm, *inner, force_per_volume);
   // An inner preconditioner of equations that have changed much is renewed by
   // its own rules, as in other solves.
   const auto solve_one =
      [&](const Vector &forces, real_t target, Vector &column)
   {
      int iterations = 0;
      bool again = true;
      while (again && iterations < most_iterations)
      {
         const SolveAttempt attempt = system.Iterate(
            most_iterations - iterations, forces, target, column);
         iterations += attempt.iterations;
         again = attempt.iterations > 0 && inner->Report(attempt) &&
                 !attempt.converged;
         if (again)
         {
            inner->Update();
         }
      }
   };
   ChangeColumns(
      [&](const std::vector<Vector> &forces, const Vector &targets,
          std::vector<Vector> &solutions)
      {
         for (std::size_t j = 0; j < forces.size(); j++)
         {
            solve_one(forces[j], targets[j], solutions[j]);
         }
      });
}

void BorderedPreconditioner::ImproveColumns()
{
   constexpr int most_iterations = 3;
   HeldSystem system(jacobian, comm, *inner, force_per_volume);
   ChangeColumns(
      [&](const std::vector<Vector> &forces, const Vector &targets,
          std::vector<Vector> &solutions)
      { system.IterateTogether(most_iterations, forces, targets, solutions); });
}

bool BorderedPreconditioner::Project()
{
   // Keeps a freedom that nothing resists from being a division by zero.
   constexpr real_t round_off = 1e-14;
   const int begin = jacobian.Offsets()[1];
   DenseMatrix middle(Columns());
   Vector product(height);
   for (Vector &column : columns)
   {
      for (const int dof : jacobian.PressureDofs())
      {
         column[begin + dof] = 0.0;
      }
   }
   bool good = true;
   for (int j = 0; j < Columns(); j++)
   {
      jacobian.Mult(Unit(j), product);
      const real_t held_stiffness = Ties().Gather(product)[j];
      const real_t alone = NormOnOthers(product);
      jacobian.Mult(columns[j], product);
      const Vector entries = Restrict(product);
      for (int i = 0; i < Columns(); i++)
      {
         middle(i, j) = entries[i];
      }
      middle(j, j) += round_off * std::abs(held_stiffness);
      good = good && NormOnOthers(product) <= alone;
   }
   inverse.Factor(middle);
   return good;
}

Vector BorderedPreconditioner::Restrict(const Vector &r) const
{
   r.HostRead();
   Vector parts(Columns());
   for (int i = 0; i < Columns(); i++)
   {
      parts[i] = columns[i] * r;
   }
   MPI_Allreduce(MPI_IN_PLACE, parts.GetData(), parts.Size(),
                 MPITypeMap<real_t>::mpi_type, MPI_SUM, comm);
   return parts;
}

int BorderedPreconditioner::Patience() const
{
   const int most = inner->Patience();
   return most < std::numeric_limits<int>::max() - Columns() ? most + Columns()
                                                             : most;
}

bool BorderedPreconditioner::Report(const SolveAttempt &attempt)
{
   // Old columns make as many iterations more as there are, at most, for which
   // the inner preconditioner is not to blame.
   SolveAttempt of_inner(attempt);
   of_inner.iterations = fresh ? attempt.iterations
                               : std::max(std::min(attempt.iterations, 1),
                                          attempt.iterations - Columns());
   const bool again = inner->Report(of_inner);
   const bool renew = !attempt.converged && !fresh && Columns() > 0;
   outdated = outdated || renew;
   return again || renew;
}

void BorderedPreconditioner::Mult(const Vector &x, Vector &y) const
{
   if (columns.empty())
   {
      inner->Mult(x, y);
      return;
   }
   right_side = x;
   Hold(right_side);
   inner->Mult(right_side, y);
   Hold(y);
   residual.SetSize(height);
   jacobian.Mult(y, residual);
   subtract(x, residual, residual);
   Vector amounts(Columns());
   inverse.Mult(Restrict(residual), amounts);
   y.HostReadWrite();
   for (int j = 0; j < Columns(); j++)
   {
      y.Add(amounts[j], columns[j]);
   }
}

} // namespace synovia
