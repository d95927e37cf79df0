#include "synovia/feb/feb_guides.hpp"

#include <algorithm>
#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
// Of the size of a surface.
constexpr real_t plane_tolerance = 1e-6;

std::set<int> NodesOfFacets(const FebMesh &mesh, const std::string &surface)
{
   std::set<int> nodes;
   const auto found = mesh.surfaces.find(surface);
   if (found != mesh.surfaces.end())
   {
      for (const std::vector<int> &facet : found->second)
      {
         nodes.insert(facet.begin(), facet.end());
      }
   }
   return nodes;
}

// The place of the rigid material that all of the nodes belong to; -1 if there
// is none.
int BodyOfNodes(const FebMesh &mesh, const FebMaterials &materials,
                const std::set<int> &nodes)
{
   for (size_t i = 0; i < materials.rigid.size(); i++)
   {
      std::set<int> rigid;
      for (const int part : materials.rigid[i].parts)
      {
         for (const FebCell &cell : mesh.parts[part].cells)
         {
            rigid.insert(cell.nodes.begin(), cell.nodes.end());
         }
      }
      if (!nodes.empty() &&
          std::includes(rigid.begin(), rigid.end(), nodes.begin(), nodes.end()))
      {
         return static_cast<int>(i);
      }
   }
   return -1;
}

// The direction across the plane in which the facets of a surface are; zero if
// they are in none.
Point3 PlaneNormal(const FebMesh &mesh, const std::string &surface)
{
   const Point3 none{{0.0, 0.0, 0.0}};
   const std::vector<std::vector<int>> &facets = mesh.surfaces.at(surface);
   Point3 normal(none);
   for (const std::vector<int> &facet : facets)
   {
      const auto at = [&](size_t i) { return mesh.nodes[facet[i]]; };
      const size_t last = facet.size() - 1;
      Point3 area = Cross(Sum(at(last == 3 ? 2 : 1), -1.0, at(0)),
                          Sum(at(last), -1.0, at(last == 3 ? 1 : 0)));
      normal = Sum(normal, Dot(area, normal) < 0.0 ? -1.0 : 1.0, area);
   }
   const real_t length = Length(normal);
   return length > 0.0 ? Sum(none, 1.0 / length, normal) : none;
}

// Whether all nodes are in the plane through the first of them.
bool AreInPlane(const FebMesh &mesh, const std::set<int> &nodes,
                const Point3 &normal)
{
   const Point3 &first = mesh.nodes[*nodes.begin()];
   real_t off = 0.0;
   real_t size = 0.0;
   for (const int node : nodes)
   {
      const Point3 arm = Sum(mesh.nodes[node], -1.0, first);
      off = std::max(off, std::abs(Dot(arm, normal)));
      size = std::max(size, Length(arm));
   }
   return off <= plane_tolerance * size;
}

void ReadGuide(const FebInput &contact, FebMesh &mesh,
               const FebMaterials &materials, std::vector<FebGuide> &guides)
{
   FebGuide guide;
   guide.pair = contact.Attribute("surface_pair");
   const auto pair = mesh.surface_pairs.find(guide.pair);
   if (pair == mesh.surface_pairs.end())
   {
      return;
   }
   const auto &[primary, secondary] = pair->second;
   std::set<int> fixed = NodesOfFacets(mesh, secondary);
   std::string plane = secondary;
   guide.surface = primary;
   guide.body = BodyOfNodes(mesh, materials, fixed);
   if (guide.body < 0)
   {
      plane = primary;
      guide.surface = secondary;
      fixed = NodesOfFacets(mesh, primary);
      guide.body = BodyOfNodes(mesh, materials, fixed);
   }
   guide.nodes = NodesOfFacets(mesh, guide.surface);
   if (guide.body >= 0 && !guide.nodes.empty())
   {
      guide.normal = PlaneNormal(mesh, plane);
      std::set<int> all(guide.nodes);
      all.insert(fixed.begin(), fixed.end());
      if (Length(guide.normal) > 0.0 && AreInPlane(mesh, all, guide.normal))
      {
         guides.push_back(guide);
         mesh.surface_pairs.erase(pair);
         return;
      }
   }
   contact.Stop("contact bears tension only along a plane of a rigid body that "
                "the surface is in");
}
} // namespace

std::vector<FebGuide> FindGuides(const FebInput &root, FebMesh &mesh,
                                 const FebMaterials &materials)
{
   std::vector<FebGuide> guides;
   const std::optional<FebInput> section = root.Find("Contact");
   if (section)
   {
      for (const FebInput &contact : section->All("contact"))
      {
         if (contact.Attribute("type") != "tied-elastic" &&
             contact.Flag("tension", false))
         {
            ReadGuide(contact, mesh, materials, guides);
         }
      }
   }
   return guides;
}

} // namespace synovia
