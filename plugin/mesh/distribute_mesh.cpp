#include "synovia/mesh/mesh_share.hpp"
#include "synovia/mesh/tangled_elements.hpp"

namespace synovia
{

using namespace mfem;

NamedMesh DistributeMesh(Mesh &serial, NameTable regions, NameTable boundaries,
                         MPI_Comm comm, const int *partitioning)
{
   std::vector<int> ranks;
   if (partitioning)
   {
      ranks.assign(partitioning, partitioning + serial.GetNE());
   }
   MeshShare share = ScatterMesh(serial, regions, boundaries, comm, ranks);
   const std::vector<int> &elements = share.serial_elements;
   ThrowIfTangled(comm, *share.mesh, {elements.begin(), elements.end()},
                  regions);
   return NamedMesh(std::move(share.mesh), std::move(regions),
                    std::move(boundaries), std::move(share.serial_elements));
}

} // namespace synovia
