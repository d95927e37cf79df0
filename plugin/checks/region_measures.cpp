#include "synovia/checks/region_measures.hpp"
#include "synovia/checks/body_shape.hpp"

#include <limits>

namespace synovia
{

using namespace mfem;

std::vector<RegionMeasures> MeasureRegions(const CaseFile &setup,
                                           CaseProblem &problem,
                                           const std::vector<Body> &bodies)
{
   NamedMesh &named = problem.Get().Mesh();
   const ParMesh &mesh = named.Get();
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
      region.rigid = material.IsRigid();
      region.aggregate_modulus = material.IsRigid()
                                    ? std::numeric_limits<real_t>::infinity()
                                    : material.solid->AggregateModulus();
      region.thickness =
         material.IsRigid() ? 0.0 : thickness[body_of[attribute]];
      if (material.HasFluid())
      {
         region.permeability = material.permeability->ReferenceValue();
         region.drainage_length = drainage[attribute];
         region.gel_time = region.drainage_length * region.drainage_length /
                           (region.aggregate_modulus * region.permeability);
      }
      regions.push_back(region);
   }
   return regions;
}

} // namespace synovia
