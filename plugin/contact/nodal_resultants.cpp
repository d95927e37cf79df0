#include "synovia/contact/nodal_resultants.hpp"

namespace synovia
{

using namespace mfem;

Point3 SumOverRanks(Point3 value, MPI_Comm comm)
{
   MPI_Allreduce(MPI_IN_PLACE, value.data(), 3, MPITypeMap<real_t>::mpi_type,
                 MPI_SUM, comm);
   return value;
}

Point3 SumOfDofs(const Vector &force, const Array<int> &dofs, MPI_Comm comm)
{
   Point3 sum{{0.0, 0.0, 0.0}};
   for (const int dof : dofs)
   {
      sum[dof % 3] += force[dof];
   }
   return SumOverRanks(sum, comm);
}

Point3 SumOfMoments(const Vector &force, const Vector &positions,
                    const Array<int> &dofs, MPI_Comm comm)
{
   Point3 sum{{0.0, 0.0, 0.0}};
   for (int i = 0; i < dofs.Size(); i += 3)
   {
      const Point3 x{positions[i], positions[i + 1], positions[i + 2]};
      const Point3 f{force[dofs[i]], force[dofs[i + 1]], force[dofs[i + 2]]};
      sum = Sum(sum, 1.0, Cross(x, f));
   }
   return SumOverRanks(sum, comm);
}

} // namespace synovia
