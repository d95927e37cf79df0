#include "synovia/mesh/region_boundaries.hpp"

namespace synovia
{

using namespace mfem;

Array<int> BoundariesOf(const ParMesh &mesh, const Array<int> &regions)
{
   Array<int> has(
      mesh.bdr_attributes.IsEmpty() ? 1 : mesh.bdr_attributes.Max() + 1);
   has = 0;
   for (int i = 0; i < mesh.GetNBE(); i++)
   {
      int element;
      int info;
      mesh.GetBdrElementAdjacentElement(i, element, info);
      if (regions.Find(mesh.GetAttribute(element)) >= 0)
      {
         has[mesh.GetBdrAttribute(i)] = 1;
      }
   }
   MPI_Allreduce(MPI_IN_PLACE, has.GetData(), has.Size(), MPI_INT, MPI_MAX,
                 mesh.GetComm());
   Array<int> boundaries;
   for (int attribute = 0; attribute < has.Size(); attribute++)
   {
      if (has[attribute])
      {
         boundaries.Append(attribute);
      }
   }
   return boundaries;
}

Array<int> BoundariesOnlyOf(const ParMesh &mesh, const Array<int> &regions)
{
   Array<int> others;
   for (const int region : mesh.attributes)
   {
      if (regions.Find(region) < 0)
      {
         others.Append(region);
      }
   }
   const Array<int> shared = BoundariesOf(mesh, others);
   Array<int> own;
   for (const int attribute : BoundariesOf(mesh, regions))
   {
      if (shared.FindSorted(attribute) < 0)
      {
         own.Append(attribute);
      }
   }
   return own;
}

} // namespace synovia
