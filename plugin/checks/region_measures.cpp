#include "checks/region_measures.hpp"
#include "checks/body_shape.hpp"
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
        quality(attributes + 1, std::numeric_limits<real_t>::infinity())
   {
   }
   void Reduce(MPI_Comm comm)
   {
      SumOverRanks(elements, comm);
      SumOverRanks(volume, comm);
      MinOverRanks(quality, comm);
   }

   std::vector<real_t> elements;
   std::vector<real_t> volume;
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
} // namespace

std::vector<RegionMeasures> MeasureRegions(const CaseFile &setup,
                                           CaseProblem &problem,
                                           const std::vector<Body> &bodies)
{
   NamedMesh &named = problem.Get().Mesh();
   ParMesh &mesh = named.Get();
   Totals totals(mesh.attributes.Max());
   AddElements(mesh, totals);
   totals.Reduce(named.GetComm());
   const std::vector<real_t> thickness =
      MeasureThickness(setup, problem, bodies);
   const std::vector<real_t> drainage =
      MeasureDrainageLengths(setup, problem, bodies);
   const std::vector<int> body_of =
      BodyOfRegions(bodies, mesh.attributes.Max());
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
      region.thickness = thickness[body_of[attribute]];
      region.drainage_length = drainage[attribute];
      region.gel_time = region.drainage_length * region.drainage_length /
                        (region.aggregate_modulus * region.permeability);
      regions.push_back(region);
   }
   return regions;
}

} // namespace synovia
