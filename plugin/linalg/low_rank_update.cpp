#include "synovia/linalg/low_rank_update.hpp"

#include <cmath>

namespace synovia
{

using namespace mfem;

void SparsePart::Add(int dof, real_t entry)
{
   dofs.push_back(dof);
   entries.push_back(entry);
}

real_t SparsePart::Times(const Vector &x) const
{
   const real_t *values = x.HostRead();
   real_t sum = 0.0;
   for (std::size_t i = 0; i < dofs.size(); i++)
   {
      sum += entries[i] * values[dofs[i]];
   }
   return sum;
}

Vector SparsePart::Dense(int size) const
{
   Vector x(size);
   x = 0.0;
   for (std::size_t i = 0; i < dofs.size(); i++)
   {
      x[dofs[i]] = entries[i];
   }
   return x;
}

void LowRankUpdate::SolveFor(const std::vector<Column *> &columns,
                             const Solver &inverse)
{
   std::vector<Vector> wanted;
   Array<const Vector *> right_sides;
   Array<Vector *> solutions;
   wanted.reserve(columns.size());
   for (Column *column : columns)
   {
      column->z.SetSize(inverse.Height());
      wanted.push_back(column->left.Dense(inverse.Height()));
      right_sides.Append(&wanted.back());
      solutions.Append(&column->z);
   }
   inverse.ArrayMult(right_sides, solutions);
}

void LowRankUpdate::Set(std::vector<const Column *> columns_, const Vector &k)
{
   columns = std::move(columns_);
   const int n = static_cast<int>(columns.size());
   if (n == 0)
   {
      return;
   }
   middle.SetSize(n);
   for (int j = 0; j < n; j++)
   {
      for (int i = 0; i < n; i++)
      {
         middle(i, j) = columns[i]->right.Times(columns[j]->z);
      }
   }
   MPI_Allreduce(MPI_IN_PLACE, middle.Data(), n * n,
                 MPITypeMap<real_t>::mpi_type, MPI_SUM, comm);
   scale.SetSize(n);
   for (int i = 0; i < n; i++)
   {
      scale[i] = 1.0 / std::sqrt(std::abs(1.0 / k[i]) + std::abs(middle(i, i)));
      middle(i, i) += 1.0 / k[i];
   }
   middle.LeftScaling(scale);
   middle.RightScaling(scale);
   inverse = std::make_unique<DenseMatrixInverse>(middle);
}

void LowRankUpdate::Correct(Vector &y) const
{
   const int n = static_cast<int>(columns.size());
   if (n == 0)
   {
      return;
   }
   Vector parts(n);
   for (int i = 0; i < n; i++)
   {
      parts[i] = columns[i]->right.Times(y);
   }
   MPI_Allreduce(MPI_IN_PLACE, parts.GetData(), n, MPITypeMap<real_t>::mpi_type,
                 MPI_SUM, comm);
   parts *= scale;
   Vector amounts(n);
   inverse->Mult(parts, amounts);
   amounts *= scale;
   for (int i = 0; i < n; i++)
   {
      y.Add(-amounts[i], columns[i]->z);
   }
}

} // namespace synovia
