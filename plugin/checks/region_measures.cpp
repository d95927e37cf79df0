#include "checks/region_measures.hpp"
#include "general/reduce_lists.hpp"
#include "mesh/element_measure.hpp"
#include "mesh/mesh_quality.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

namespace
{
/// Sums and minima by attribute.
struct Totals
{
   explicit Totals(int attributes)
      : elements(attributes + 1, 0.0), volume(elements),
        draining_area(elements),
        quality(attributes + 1, std::numeric_limits<real_t>::infinity())
   {
   }
   void Reduce(MPI_Comm comm)
   {
      SumOverRanks(elements, comm);
      SumOverRanks(volume, comm);
      SumOverRanks(draining_area, comm);
      MinOverRanks(quality, comm);
   }

   std::vector<real_t> elements;
   std::vector<real_t> volume;
   std::vector<real_t> draining_area;
   std::vector<real_t> quality;
};

void AddElements(ParMesh &mesh, Totals &totals)
{
   const Vector jacobians = ScaledJacobians(mesh);
   for (int i = 0; i < mesh.GetNE(); i++)
   {
      const int region = mesh.GetAttribute(i);
      totals.elements[region] += 1.0;
      totals.volume[region] += Measure(*mesh.GetElementTransformation(i));
      totals.quality[region] = std::min(totals.quality[region], jacobians[i]);
   }
}

void AddDrainingFaces(ParMesh &mesh, const Array<int> &draining, Totals &totals)
{
   for (int i = 0; i < mesh.GetNBE(); i++)
   {
      if (draining.Find(mesh.GetBdrAttribute(i)) >= 0)
      {
         int element;
         int info;
         mesh.GetBdrElementAdjacentElement(i, element, info);
         totals.draining_area[mesh.GetAttribute(element)] +=
            Measure(*mesh.GetBdrElementTransformation(i));
      }
   }
}
} // namespace

Array<int> DrainingSurfaces(const CaseFile &setup, const NamedMesh &mesh)
{
   Array<int> draining = ContactSurfaces(setup, mesh);
   for (const BoundaryCase &boundary : setup.boundaries)
   {
      if (boundary.pressure)
      {
         for (const std::string &name : boundary.surfaces)
         {
            draining.Append(mesh.Boundary(name));
         }
      }
   }
   return draining;
}

std::vector<RegionMeasures> MeasureRegions(const CaseFile &setup,
                                           CaseProblem &problem)
{
   NamedMesh &named = problem.Get().Mesh();
   ParMesh &mesh = named.Get();
   Totals totals(mesh.attributes.Max());
   AddElements(mesh, totals);
   AddDrainingFaces(mesh, DrainingSurfaces(setup, named), totals);
   totals.Reduce(named.GetComm());
   std::vector<RegionMeasures> regions;
   for (const int attribute : mesh.attributes)
   {
      const Material &material = problem.Get().Materials().Get(attribute);
      RegionMeasures region;
      region.name = NameOf(named.Regions(), attribute);
      region.attribute = attribute;
      region.elements = static_cast<long long>(totals.elements[attribute]);
      region.volume = totals.volume[attribute];
      region.quality = totals.quality[attribute];
      region.aggregate_modulus = material.solid->AggregateModulus();
      region.permeability = material.permeability->Typical();
      if (totals.draining_area[attribute] > 0.0)
      {
         region.thickness = region.volume / totals.draining_area[attribute];
         region.gel_time = region.thickness * region.thickness /
                           (region.aggregate_modulus * region.permeability);
      }
      regions.push_back(region);
   }
   return regions;
}

} // namespace synovia
