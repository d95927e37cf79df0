#include "support/traction_moments.hpp"

namespace synovia
{

using namespace mfem;

TractionMoments MeasureTraction(BiphasicProblem &problem)
{
   const ContactPair &pair = *problem.Operator().Pairs().front();
   const Vector &traction = pair.State().traction;
   const Vector &area = pair.Constraint().Coverage().area;
   FunctionCoefficient squared([](const Vector &x)
                               { return x[0] * x[0] + x[1] * x[1]; });
   ParGridFunction field(&problem.Spaces().Multiplier());
   field.ProjectCoefficient(squared);
   Vector everywhere;
   field.GetTrueDofs(everywhere);
   const Vector r2 =
      pair.Geometry().Destination().Vertices().FromTrueDofs(everywhere);
   real_t sums[2] = {0.0, 0.0};
   for (int j = 0; j < traction.Size(); j++)
   {
      sums[0] -= traction[j] * area[j];
      sums[1] -= traction[j] * area[j] * r2[j];
   }
   MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPITypeMap<real_t>::mpi_type, MPI_SUM,
                 problem.Mesh().GetComm());
   return {sums[0], sums[1] / sums[0]};
}

} // namespace synovia
