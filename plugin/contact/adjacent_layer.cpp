#include "synovia/contact/adjacent_layer.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/mesh/element_measure.hpp"

#include <algorithm>
#include <limits>

namespace synovia
{

using namespace mfem;

AdjacentLayer::AdjacentLayer(ParMesh &mesh, const Array<int> &boundary)
{
   std::vector<int> adjacent(mesh.attributes.Max() + 1, 0);
   for (int i = 0; i < mesh.GetNBE(); i++)
   {
      if (boundary.Find(mesh.GetBdrAttribute(i)) >= 0)
      {
         int element;
         int info;
         mesh.GetBdrElementAdjacentElement(i, element, info);
         adjacent[mesh.GetAttribute(element)] = 1;
         area += Measure(*mesh.GetBdrElementTransformation(i));
      }
   }
   MPI_Allreduce(MPI_IN_PLACE, adjacent.data(),
                 static_cast<int>(adjacent.size()), MPI_INT, MPI_MAX,
                 mesh.GetComm());
   for (int i = 0; i < mesh.GetNE(); i++)
   {
      if (adjacent[mesh.GetAttribute(i)])
      {
         volume += Measure(*mesh.GetElementTransformation(i));
      }
   }
   for (size_t attribute = 0; attribute < adjacent.size(); attribute++)
   {
      if (adjacent[attribute])
      {
         regions.Append(static_cast<int>(attribute));
      }
   }
   area = SumOverRanks(area, mesh.GetComm());
   volume = SumOverRanks(volume, mesh.GetComm());
}

real_t AdjacentLayer::SoftestModulus(const MaterialTable &materials) const
{
   real_t softest = std::numeric_limits<real_t>::max();
   for (const int region : regions)
   {
      softest =
         std::min(softest, materials.Get(region).solid->AggregateModulus());
   }
   return softest;
}

real_t AdjacentLayer::LeastPermeability(const MaterialTable &materials) const
{
   real_t least = std::numeric_limits<real_t>::max();
   for (const int region : regions)
   {
      least =
         std::min(least, materials.Get(region).permeability->ReferenceValue());
   }
   return least;
}

} // namespace synovia
