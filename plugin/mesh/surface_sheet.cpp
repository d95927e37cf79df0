#include "synovia/mesh/surface_sheet.hpp"

#include <map>
#include <utility>

namespace synovia
{

using namespace mfem;

namespace
{
using Edge = std::pair<int, int>;

int Corners(const SurfaceSheet::Facet &facet)
{
   return facet.corners[3] < 0 ? 3 : 4;
}

// The edges of one facet only, in its direction.
std::map<Edge, Edge> FindRim(const SurfaceSheet &sheet)
{
   std::map<Edge, Edge> rim;
   for (const SurfaceSheet::Facet &facet : sheet.facets)
   {
      const int corners = Corners(facet);
      for (int i = 0; i < corners; i++)
      {
         const int a = facet.corners[i];
         const int b = facet.corners[(i + 1) % corners];
         const Edge key = std::minmax(a, b);
         if (!rim.emplace(key, Edge{a, b}).second)
         {
            rim.erase(key);
         }
      }
   }
   return rim;
}
} // namespace

int SurfaceSheet::Add(const Point3 &on_surface, const Point3 &below)
{
   outer.push_back(on_surface);
   inner.push_back(below);
   return static_cast<int>(outer.size()) - 1;
}

void SurfaceSheet::AddTriangle(int a, int b, int c, int attribute)
{
   facets.push_back({{a, b, c, -1}, attribute});
}

void SurfaceSheet::AddQuadrilateral(int a, int b, int c, int d, int attribute)
{
   facets.push_back({{a, b, c, d}, attribute});
}

Mesh MakeLayer(const SurfaceSheet &sheet, int back)
{
   const int corners = static_cast<int>(sheet.outer.size());
   const int facets = static_cast<int>(sheet.facets.size());
   const std::map<Edge, Edge> rim = FindRim(sheet);
   Mesh mesh(3, 2 * corners, facets, 2 * facets + static_cast<int>(rim.size()),
             3);
   for (const std::vector<Point3> *side : {&sheet.inner, &sheet.outer})
   {
      for (const Point3 &point : *side)
      {
         mesh.AddVertex(point.data());
      }
   }
   for (const SurfaceSheet::Facet &facet : sheet.facets)
   {
      const auto &c = facet.corners;
      const int o = corners;
      if (Corners(facet) == 3)
      {
         mesh.AddWedge(c[0], c[1], c[2], o + c[0], o + c[1], o + c[2]);
         mesh.AddBdrTriangle(o + c[0], o + c[1], o + c[2], facet.attribute);
         mesh.AddBdrTriangle(c[2], c[1], c[0], back);
      }
      else
      {
         mesh.AddHex(c[0], c[1], c[2], c[3], o + c[0], o + c[1], o + c[2],
                     o + c[3]);
         mesh.AddBdrQuad(o + c[0], o + c[1], o + c[2], o + c[3],
                         facet.attribute);
         mesh.AddBdrQuad(c[3], c[2], c[1], c[0], back);
      }
   }
   for (const auto &[key, edge] : rim)
   {
      const auto [a, b] = edge;
      mesh.AddBdrQuad(a, b, corners + b, corners + a, back);
   }
   mesh.FinalizeTopology(false);
   mesh.Finalize(false, true);
   return mesh;
}

} // namespace synovia
