#include "synovia/fem/spring_foundation.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/general/text.hpp"
#include "synovia/mesh/boundary_marker.hpp"
#include "synovia/mesh/element_measure.hpp"

#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
real_t Area(ParMesh &mesh, const Array<int> &marker)
{
   real_t area = 0.0;
   for (int i = 0; i < mesh.GetNBE(); i++)
   {
      if (marker[mesh.GetBdrAttribute(i) - 1])
      {
         area += Measure(*mesh.GetBdrElementTransformation(i));
      }
   }
   return SumOverRanks(area, mesh.GetComm());
}

// The identity, or d d^T for the unit vector d.
DenseMatrix Directions(const Vector &direction)
{
   DenseMatrix directions(3);
   directions = 0.0;
   if (direction.Size() == 0)
   {
      for (int d = 0; d < 3; d++)
      {
         directions(d, d) = 1.0;
      }
      return directions;
   }
   bool finite = true;
   for (const real_t component : direction)
   {
      finite = finite && std::isfinite(component);
   }
   const real_t largest = direction.Normlinf();
   if (!finite || !(largest > 0.0))
   {
      throw Error("the direction of springs is zero or not finite; give a "
                  "vector, or none for springs that act alike in all "
                  "directions");
   }
   // Squares of the components themselves might overflow, or vanish.
   Vector unit(direction);
   unit /= largest;
   unit /= unit.Norml2();
   MultVVt(unit, directions);
   return directions;
}
} // namespace

SpringFoundation::SpringFoundation(BiphasicSpaces &spaces,
                                   const Array<int> &boundary, real_t stiffness,
                                   const Vector &direction)
{
   if (!(stiffness > 0.0) || !std::isfinite(stiffness))
   {
      throw Error("the stiffness of springs is " + ToText(stiffness) +
                  "; it must be positive");
   }
   ParMesh &mesh = spaces.GetMesh();
   Array<int> marker = BoundaryMarker(mesh, boundary);
   DenseMatrix density = Directions(direction);
   density *= stiffness / Area(mesh, marker);
   MatrixConstantCoefficient coefficient(density);
   ParBilinearForm form(&spaces.Displacement());
   form.AddBoundaryIntegrator(new VectorMassIntegrator(coefficient), marker);
   form.Assemble();
   form.Finalize();
   matrix.reset(form.ParallelAssemble());
}

Point3 SpringFoundation::Force(const Vector &u) const
{
   Vector force(matrix->Height());
   matrix->Mult(-1.0, u, 0.0, force);
   force.HostRead();
   Point3 sum{{0.0, 0.0, 0.0}};
   for (int i = 0; i < force.Size(); i++)
   {
      sum[i % 3] += force[i];
   }
   MPI_Allreduce(MPI_IN_PLACE, sum.data(), 3, MPITypeMap<real_t>::mpi_type,
                 MPI_SUM, matrix->GetComm());
   return sum;
}

} // namespace synovia
