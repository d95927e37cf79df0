#include "synovia/checks/surface_measures.hpp"
#include "synovia/checks/surface_conditions.hpp"
#include "synovia/general/reduce_lists.hpp"
#include "synovia/mesh/element_measure.hpp"
#include "synovia/mesh/triangulated_surface.hpp"

#include <set>
#include <utility>

namespace synovia
{

using namespace mfem;

namespace
{
// Named surfaces, and all others as one.
std::vector<std::pair<std::string, std::vector<int>>>
Surfaces(const NamedMesh &mesh)
{
   std::vector<std::pair<std::string, std::vector<int>>> surfaces;
   std::set<int> named;
   for (const auto &[name, attributes] : mesh.Boundaries())
   {
      surfaces.emplace_back(name, attributes);
      named.insert(attributes.begin(), attributes.end());
   }
   std::vector<int> others;
   for (const int attribute : mesh.Get().bdr_attributes)
   {
      if (!named.count(attribute))
      {
         others.push_back(attribute);
      }
   }
   if (!others.empty())
   {
      surfaces.emplace_back("(without a name)", others);
   }
   return surfaces;
}
} // namespace

std::vector<SurfaceMeasures> MeasureSurfaces(const CaseFile &setup,
                                             NamedMesh &named)
{
   ParMesh &mesh = named.Get();
   const int count =
      mesh.bdr_attributes.IsEmpty() ? 1 : mesh.bdr_attributes.Max() + 1;
   std::vector<real_t> faces(count, 0.0);
   std::vector<real_t> area(count, 0.0);
   for (int i = 0; i < mesh.GetNBE(); i++)
   {
      const int surface = mesh.GetBdrAttribute(i);
      faces[surface] += 1.0;
      area[surface] += Measure(*mesh.GetBdrElementTransformation(i));
   }
   SumOverRanks(faces, named.GetComm());
   SumOverRanks(area, named.GetComm());
   const SurfaceConditions conditions(setup, named);
   std::vector<SurfaceMeasures> surfaces;
   for (const auto &[name, attributes] : Surfaces(named))
   {
      SurfaceMeasures surface;
      surface.name = name;
      std::set<std::string> words;
      for (const int attribute : attributes)
      {
         surface.faces += static_cast<long long>(faces[attribute]);
         surface.area += area[attribute];
         words.insert(conditions.Text(attribute));
      }
      for (const std::string &word : words)
      {
         surface.conditions += (surface.conditions.empty() ? "" : " / ") + word;
      }
      surfaces.push_back(surface);
   }
   return surfaces;
}

std::vector<DirectedArea> MeasureDirectedAreas(NamedMesh &named)
{
   ParMesh &mesh = named.Get();
   const int count =
      mesh.bdr_attributes.IsEmpty() ? 1 : mesh.bdr_attributes.Max() + 1;
   std::vector<real_t> sums(4 * count, 0.0);
   for (int i = 0; i < mesh.GetNBE(); i++)
   {
      real_t *const sum = &sums[4 * mesh.GetBdrAttribute(i)];
      for (const Triangle &triangle : Triangulate(mesh, i))
      {
         const Point3 twice = AreaVector(triangle);
         for (int d = 0; d < 3; d++)
         {
            sum[d] += 0.5 * twice[d];
         }
         sum[3] += 0.5 * Length(twice);
      }
   }
   SumOverRanks(sums, named.GetComm());
   std::vector<DirectedArea> areas;
   for (int a = 0; a < count; a++)
   {
      const real_t *const sum = &sums[4 * a];
      areas.push_back({{sum[0], sum[1], sum[2]}, sum[3]});
   }
   return areas;
}

} // namespace synovia
