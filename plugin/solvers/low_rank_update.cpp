#include "solvers/low_rank_update.hpp"

namespace synovia
{

using namespace mfem;

void LowRankUpdate::Set(std::vector<const Column *> columns_,
                        const DenseMatrix &k)
{
   columns = std::move(columns_);
   const int n = static_cast<int>(columns.size());
   if (n == 0)
   {
      return;
   }
   DenseMatrix products(n);
   for (int i = 0; i < n; i++)
   {
      for (int j = 0; j < n; j++)
      {
         products(i, j) = columns[i]->w * columns[j]->z;
      }
   }
   MPI_Allreduce(MPI_IN_PLACE, products.Data(), n * n,
                 MPITypeMap<real_t>::mpi_type, MPI_SUM, comm);
   DenseMatrix sum(n);
   Mult(products, k, sum);
   for (int i = 0; i < n; i++)
   {
      sum(i, i) += 1.0;
   }
   sum.Invert();
   middle.SetSize(n);
   Mult(k, sum, middle);
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
      parts[i] = columns[i]->w * y;
   }
   MPI_Allreduce(MPI_IN_PLACE, parts.GetData(), n, MPITypeMap<real_t>::mpi_type,
                 MPI_SUM, comm);
   Vector amounts(n);
   middle.Mult(parts, amounts);
   for (int i = 0; i < n; i++)
   {
      y.Add(-amounts[i], columns[i]->z);
   }
}

} // namespace synovia
