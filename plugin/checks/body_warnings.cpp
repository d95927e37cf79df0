#include "synovia/checks/body_warnings.hpp"
#include "synovia/checks/body_shape.hpp"
#include "synovia/checks/loose_bodies.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

std::vector<std::string>
FindBodyWarnings(const CaseFile &setup, CaseProblem &problem,
                 const std::vector<PairAtStart> &pairs,
                 const std::vector<Body> &bodies,
                 const std::vector<RegionMeasures> &regions)
{
   const std::string place = WhereIs(setup.places, "boundary");
   const Array<int> draining = DrainingSurfaces(setup, problem.Get().Mesh());
   std::vector<std::string> warnings;
   const auto has_fluid = [&](const Body &body)
   {
      return std::any_of(
         body.regions.begin(), body.regions.end(),
         [&](int region)
         { return problem.Get().Materials().Get(region).HasFluid(); });
   };
   for (const Body &body : bodies)
   {
      if (has_fluid(body) && !body.Touches(draining))
      {
         warnings.push_back(place + ": no fluid can leave \"" + body.name +
                            "\": it has no surface with a pressure or in a "
                            "contact pair");
      }
   }
   for (const std::string &loose :
        FindLooseBodies(setup, problem, pairs, bodies, regions))
   {
      warnings.push_back(place + ": " + loose);
   }
   return warnings;
}

} // namespace synovia
