#include "support/mesh_measures.hpp"

namespace synovia
{

using namespace mfem;

namespace
{

real_t Measure(ElementTransformation &map)
{
   const IntegrationRule &rule =
      IntRules.Get(map.GetGeometryType(), 3 * map.Order() + 3);
   real_t measure = 0.0;
   for (int i = 0; i < rule.GetNPoints(); i++)
   {
      map.SetIntPoint(&rule.IntPoint(i));
      measure += rule.IntPoint(i).weight * map.Weight();
   }
   return measure;
}

real_t Sum(MPI_Comm comm, real_t mine)
{
   real_t sum = 0.0;
   MPI_Allreduce(&mine, &sum, 1, MPITypeMap<real_t>::mpi_type, MPI_SUM, comm);
   return sum;
}

} // namespace

real_t RegionVolume(const NamedMesh &named, const std::string &region)
{
   const ParMesh &mesh = named.Get();
   const Array<int> attributes = named.Region(region);
   IsoparametricTransformation map;
   real_t volume = 0.0;
   for (int i = 0; i < mesh.GetNE(); i++)
   {
      if (attributes.Find(mesh.GetAttribute(i)) >= 0)
      {
         mesh.GetElementTransformation(i, &map);
         volume += Measure(map);
      }
   }
   return Sum(named.GetComm(), volume);
}

real_t BoundaryArea(const NamedMesh &named, const std::string &boundary)
{
   const ParMesh &mesh = named.Get();
   const Array<int> attributes = named.Boundary(boundary);
   IsoparametricTransformation map;
   real_t area = 0.0;
   for (int i = 0; i < mesh.GetNBE(); i++)
   {
      if (attributes.Find(mesh.GetBdrAttribute(i)) >= 0)
      {
         mesh.GetBdrElementTransformation(i, &map);
         area += Measure(map);
      }
   }
   return Sum(named.GetComm(), area);
}

} // namespace synovia
