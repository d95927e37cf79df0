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
      const Material &material = materials.Get(region);
      if (!material.IsRigid())
      {
         softest = std::min(softest, material.solid->AggregateModulus());
      }
   }
   return softest;
}

real_t AdjacentLayer::LeastPermeability(const MaterialTable &materials) const
{
   real_t least = std::numeric_limits<real_t>::max();
   for (const int region : materials.WithFluid(regions))
   {
      least =
         std::min(least, materials.Get(region).permeability->ReferenceValue());
   }
   return least;
}

real_t AdjacentLayer::LargestSolidFraction(const MaterialTable &materials) const
{
   real_t largest = 0.0;
   for (const int region : regions)
   {
      const Material &material = materials.Get(region);
      largest = std::max(largest, material.HasFluid() ? material.solid_fraction
                                                      : real_t(1.0));
   }
   return largest;
}

bool AdjacentLayer::IsRigid(const MaterialTable &materials) const
{
   return std::any_of(regions.begin(), regions.end(),
                      [&](int region)
                      { return materials.Get(region).IsRigid(); });
}

int AdjacentLayer::WithFluid(const MaterialTable &materials) const
{
   return materials.WithFluid(regions).Size();
}

} // namespace synovia
