#include "synovia/physics/resisted_motions.hpp"

namespace synovia
{

using namespace mfem;

void AddSquare(const RigidMotions &motions, int dof, real_t s, DenseMatrix &sum)
{
   constexpr int per_body = RigidMotions::per_body;
   const int first = per_body * motions.BodyOf(dof);
   for (int j = 0; j < per_body; j++)
   {
      for (int i = 0; i < per_body; i++)
      {
         sum(first + i, first + j) +=
            s * motions.At(dof, i) * motions.At(dof, j);
      }
   }
}

void AddScaled(const DenseMatrix &part, DenseMatrix &sum)
{
   const real_t scale = part.MaxMaxNorm();
   if (scale > 0.0)
   {
      sum.Add(1.0 / scale, part);
   }
}

void SumOverRanks(DenseMatrix &matrix, MPI_Comm comm)
{
   MPI_Allreduce(MPI_IN_PLACE, matrix.Data(), matrix.Height() * matrix.Width(),
                 MPITypeMap<real_t>::mpi_type, MPI_SUM, comm);
}

} // namespace synovia
