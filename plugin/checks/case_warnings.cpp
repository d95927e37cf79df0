#include "synovia/checks/case_warnings.hpp"
#include "synovia/checks/body_warnings.hpp"
#include "synovia/checks/cut_planes.hpp"
#include "synovia/checks/material_warnings.hpp"
#include "synovia/checks/time_warnings.hpp"
#include "synovia/checks/unit_warnings.hpp"

namespace synovia
{

using namespace mfem;

std::vector<std::string> FindWarnings(const CaseFile &setup,
                                      CaseProblem &problem,
                                      const std::vector<PairAtStart> &pairs)
{
   const std::vector<Body> bodies = problem.Get().Bodies();
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
         FindCutWarnings(setup, problem, bodies)})
   {
      warnings.insert(warnings.end(), found.begin(), found.end());
   }
   return warnings;
}

} // namespace synovia
