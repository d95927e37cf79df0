#include "synovia/checks/region_stiffness.hpp"
#include "synovia/general/reduce_lists.hpp"
#include "synovia/general/text_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace synovia
{

using namespace mfem;

namespace
{
// The path of the material that a region has.
std::string PathOfMaterial(const CaseFile &setup, const NamedMesh &mesh,
                           int region)
{
   for (size_t i = 0; i < setup.materials.size(); i++)
   {
      for (const std::string &name : setup.materials[i].regions)
      {
         if (mesh.Region(name).Find(region) >= 0)
         {
            return "material." + std::to_string(i);
         }
      }
   }
   return "material";
}

std::vector<StiffnessRange> FindRanges(CaseProblem &problem)
{
   ParMesh &mesh = problem.Get().Mesh().Get();
   const MaterialTable &materials = problem.Get().Materials();
   const int count = mesh.attributes.Max() + 1;
   std::vector<real_t> least(count, std::numeric_limits<real_t>::infinity());
   std::vector<real_t> largest(count, 0.0);
   for (int i = 0; i < mesh.GetNE(); i++)
   {
      const int region = mesh.GetAttribute(i);
      if (materials.Get(region).IsRigid())
      {
         continue;
      }
      const StiffnessRange range = RangeOfStiffness(
         *materials.Get(region).solid, *mesh.GetElementTransformation(i));
      least[region] = std::min(least[region], range.least);
      largest[region] = std::max(largest[region], range.largest);
   }
   MinOverRanks(least, mesh.GetComm());
   MaxOverRanks(largest, mesh.GetComm());
   std::vector<StiffnessRange> ranges;
   for (const int region : mesh.attributes)
   {
      ranges.push_back({least[region], largest[region]});
   }
   return ranges;
}
} // namespace

std::vector<StiffnessRange> VerifiedStiffness(const CaseFile &setup,
                                              CaseProblem &problem)
{
   const NamedMesh &mesh = problem.Get().Mesh();
   const std::vector<StiffnessRange> ranges = FindRanges(problem);
   CaseReading reading(setup.places);
   for (size_t i = 0; i < ranges.size(); i++)
   {
      const int region = mesh.Get().attributes[static_cast<int>(i)];
      if (!problem.Get().Materials().Get(region).IsRigid() &&
          (!(ranges[i].least > 0.0) || !std::isfinite(ranges[i].largest)))
      {
         reading.AddError(
            PathOfMaterial(setup, mesh, region) + ".solid",
            "the stiffness of \"" + NameOf(mesh.Regions(), region) +
               "\" is not positive definite: its eigenvalues go from " +
               Quantity(ranges[i].least) + " to " +
               Quantity(ranges[i].largest));
      }
   }
   reading.ThrowIfAny();
   return ranges;
}

} // namespace synovia
