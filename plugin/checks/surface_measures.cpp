#include "checks/surface_measures.hpp"
#include "general/reduce_lists.hpp"
#include "mesh/element_measure.hpp"

namespace synovia
{

using namespace mfem;

std::vector<SurfaceMeasures> MeasureSurfaces(NamedMesh &named)
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
   std::vector<SurfaceMeasures> surfaces;
   for (const auto &[name, attributes] : named.Boundaries())
   {
      SurfaceMeasures surface;
      surface.name = name;
      for (const int attribute : attributes)
      {
         surface.faces += static_cast<long long>(faces[attribute]);
         surface.area += area[attribute];
      }
      surfaces.push_back(surface);
   }
   return surfaces;
}

} // namespace synovia
