#include "checks/case_warnings.hpp"
#include "checks/body_warnings.hpp"
#include "checks/cut_planes.hpp"
#include "checks/material_warnings.hpp"
#include "checks/time_warnings.hpp"
#include "checks/unit_warnings.hpp"
#include "general/text_table.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
// Elements below this are flat enough to spoil stresses and iterations.
constexpr real_t poor_quality = 0.05;

std::vector<std::string>
FindQualityWarnings(const std::vector<RegionMeasures> &regions)
{
   std::vector<std::string> warnings;
   for (const RegionMeasures &region : regions)
   {
      if (region.quality < poor_quality)
      {
         warnings.push_back("the worst element of \"" + region.name +
                            "\" has a scaled Jacobian of " +
                            Quantity(region.quality) +
                            " (1 is perfect, 0 is flat)");
      }
   }
   return warnings;
}
} // namespace

std::vector<std::string> FindWarnings(const CaseFile &setup,
                                      CaseProblem &problem,
                                      const std::vector<PairAtStart> &pairs)
{
   const std::vector<Body> bodies =
      FindBodies(problem.Get().Mesh(), problem.Get().Spaces());
   return FindWarnings(setup, problem, pairs, bodies,
                       MeasureRegions(setup, problem, bodies));
}

std::vector<std::string>
FindWarnings(const CaseFile &setup, CaseProblem &problem,
             const std::vector<PairAtStart> &pairs,
             const std::vector<Body> &bodies,
             const std::vector<RegionMeasures> &regions)
{
   std::vector<std::string> warnings;
   for (const auto &found :
        {FindUnitWarnings(setup, problem, pairs, bodies, regions),
         FindMaterialWarnings(setup), FindTimeWarnings(setup),
         FindBodyWarnings(setup, problem, pairs, bodies, regions),
         FindCutWarnings(setup, problem, bodies), FindQualityWarnings(regions)})
   {
      warnings.insert(warnings.end(), found.begin(), found.end());
   }
   return warnings;
}

} // namespace synovia
