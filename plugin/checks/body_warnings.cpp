#include "checks/body_warnings.hpp"
#include "checks/region_measures.hpp"
#include "physics/body.hpp"

namespace synovia
{

using namespace mfem;

std::vector<std::string> FindBodyWarnings(const CaseFile &setup,
                                          CaseProblem &problem)
{
   NamedMesh &mesh = problem.Get().Mesh();
   const Array<int> draining = DrainingSurfaces(setup, mesh);
   const char *const axes[3] = {"x", "y", "z"};
   const Array<int> held[3] = {HeldSurfaces(setup, mesh, 0),
                               HeldSurfaces(setup, mesh, 1),
                               HeldSurfaces(setup, mesh, 2)};
   std::vector<std::string> warnings;
   for (const Body &body : FindBodies(mesh, problem.Get().Spaces()))
   {
      if (!body.Touches(draining))
      {
         warnings.push_back("no fluid can leave \"" + body.name +
                            "\": it has no surface with a pressure or in a "
                            "contact pair");
      }
      for (int d = 0; d < 3; d++)
      {
         if (!body.Touches(held[d]))
         {
            warnings.push_back("only contact holds \"" + body.name +
                               "\" along " + axes[d]);
         }
      }
   }
   return warnings;
}

} // namespace synovia
