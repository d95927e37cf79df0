#include "synovia/fem/stabilized_volume.hpp"
#include "synovia/fem/node_positions.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/reduce.hpp"

#include <cmath>

namespace synovia
{

using namespace mfem;

StabilizedVolume::StabilizedVolume(const NamedMesh &mesh_,
                                   BiphasicSpaces &spaces_,
                                   const MaterialTable &materials_,
                                   const HypreParMatrix &stabilization_)
   : mesh(mesh_), spaces(spaces_), materials(materials_),
     stabilization(stabilization_), smooth_stabilization(spaces, materials),
     positions(NodePositions(spaces.Displacement())),
     volumes(spaces.Pressure().GetTrueVSize())
{
   const Array<int> &regions = spaces.GetMesh().attributes;
   Array<int> wet(regions.Max());
   wet = 0;
   for (const int region : materials.WithFluid(regions))
   {
      wet[region - 1] = 1;
   }
   ConstantCoefficient one(1.0);
   ParLinearForm form(&spaces.Pressure());
   form.AddDomainIntegrator(new DomainLFIntegrator(one), wet);
   form.Assemble();
   form.ParallelAssemble(volumes);
}

StrainExtreme StabilizedVolume::FindLargest(const Vector &p) const
{
   Vector taken(p.Size());
   Vector smooth(p.Size());
   stabilization.Mult(p, taken);
   smooth_stabilization.Mult(p, smooth);
   taken -= smooth;
   taken.HostRead();
   volumes.HostRead();
   real_t largest_here = 0.0;
   int at = -1;
   for (int i = 0; i < taken.Size(); i++)
   {
      const real_t part =
         volumes[i] > 0.0 ? std::abs(taken[i]) / volumes[i] : 0.0;
      if (part > largest_here)
      {
         largest_here = part;
         at = i;
      }
   }
   MPI_Comm comm = spaces.GetComm();
   const RankedValue largest = LargestOverRanks(largest_here, comm);
   StrainExtreme extreme;
   extreme.value = largest.value;
   const bool here = largest.here && at >= 0;
   for (int d = 0; d < 3 && here; d++)
   {
      // The three components of a node follow each other.
      extreme.place[d] = positions[3 * at + d];
   }
   MPI_Bcast(extreme.place.data(), 3, MPITypeMap<real_t>::mpi_type,
             largest.rank, comm);
   extreme.region = AgreeOnText(comm, here ? RegionAt(at) : "");
   return extreme;
}

std::string StabilizedVolume::RegionAt(int true_dof) const
{
   const ParFiniteElementSpace &space = spaces.Pressure();
   Array<int> dofs;
   for (int e = 0; e < space.GetNE(); e++)
   {
      const int region = spaces.GetMesh().GetAttribute(e);
      space.GetElementDofs(e, dofs);
      for (const int dof : dofs)
      {
         if (space.GetLocalTDofNumber(dof) == true_dof &&
             materials.Get(region).HasFluid())
         {
            return NameOf(mesh.Regions(), region);
         }
      }
   }
   return "";
}

} // namespace synovia
