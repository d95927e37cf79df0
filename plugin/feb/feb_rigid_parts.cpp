#include "synovia/feb/feb_rigid_parts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace synovia
{

using namespace mfem;

namespace
{
constexpr int surface_dimension = 2;
// Thickness of what shells become, of the root of their elements' area.
constexpr real_t thin = 0.1;

std::vector<int> Corners(const FebPart &part, const FebCell &cell)
{
   return {cell.nodes.begin(), cell.nodes.begin() + part.shape->corners};
}

// The faces of a part by their sorted corners; shells are faces themselves.
void AddFaces(const FebPart &part, std::set<std::vector<int>> &faces)
{
   for (const FebCell &cell : part.cells)
   {
      if (part.shape->dimension == surface_dimension)
      {
         faces.insert(Sorted(Corners(part, cell)));
         continue;
      }
      for (const std::vector<int> &list : part.shape->faces)
      {
         std::vector<int> corners;
         for (const int place : list)
         {
            if (place < part.shape->corners)
            {
               corners.push_back(cell.nodes[place]);
            }
         }
         faces.insert(Sorted(corners));
      }
   }
}

// All facets of pairs, as they are seen from outside, by their sorted corners.
std::map<std::vector<int>, std::vector<int>> FacetsOfPairs(const FebMesh &mesh)
{
   std::map<std::vector<int>, std::vector<int>> facets;
   for (const auto &[name, pair] : mesh.surface_pairs)
   {
      for (const std::string &side : {pair.first, pair.second})
      {
         const auto surface = mesh.surfaces.find(side);
         if (surface != mesh.surfaces.end())
         {
            for (const std::vector<int> &facet : surface->second)
            {
               facets[Sorted(facet)] = facet;
            }
         }
      }
   }
   return facets;
}

Point3 AreaVector(const FebMesh &mesh, const std::vector<int> &facet)
{
   const auto at = [&](size_t i) { return mesh.nodes[facet[i]]; };
   const size_t last = facet.size() - 1;
   const Point3 twice = Cross(Sum(at(last == 3 ? 2 : 1), -1.0, at(0)),
                              Sum(at(last), -1.0, at(last == 3 ? 1 : 0)));
   return Sum({{0.0, 0.0, 0.0}}, 0.5, twice);
}

void Thicken(const std::map<std::vector<int>, std::vector<int>> &facets,
             FebPart &part, FebMesh &mesh)
{
   std::map<int, Point3> normals;
   real_t least = std::numeric_limits<real_t>::infinity();
   for (FebCell &cell : part.cells)
   {
      std::vector<int> corners = Corners(part, cell);
      const auto facet = facets.find(Sorted(corners));
      cell.nodes = facet == facets.end() ? corners : facet->second;
      const Point3 area = AreaVector(mesh, cell.nodes);
      least = std::min(least, Length(area));
      for (const int node : cell.nodes)
      {
         Point3 &normal = normals[node];
         normal = Sum(normal, 1.0, area);
      }
   }
   long long number =
      *std::max_element(mesh.numbers.begin(), mesh.numbers.end());
   std::map<int, int> below;
   for (const auto &[node, normal] : normals)
   {
      below[node] = static_cast<int>(mesh.nodes.size());
      const real_t length = Length(normal);
      const real_t depth =
         length > 0.0 ? thin * std::sqrt(least) / length : 0.0;
      mesh.nodes.push_back(Sum(mesh.nodes[node], -depth, normal));
      mesh.numbers.push_back(++number);
   }
   for (FebCell &cell : part.cells)
   {
      std::vector<int> nodes;
      for (const int node : cell.nodes)
      {
         nodes.push_back(below[node]);
      }
      nodes.insert(nodes.end(), cell.nodes.begin(), cell.nodes.end());
      cell.nodes = nodes;
   }
   part.shape = FindFebShape(part.shape->corners == 3 ? "penta6" : "hex8");
}
} // namespace

std::set<int> FindTouchingParts(const FebMesh &mesh,
                                const FebMaterials &materials)
{
   const auto facets = FacetsOfPairs(mesh);
   std::set<std::vector<int>> deformable;
   for (const int part : materials.deformable)
   {
      AddFaces(mesh.parts[part], deformable);
   }
   std::set<int> touching;
   for (const FebRigidMaterial &body : materials.rigid)
   {
      std::set<std::vector<int>> faces;
      for (const int part : body.parts)
      {
         AddFaces(mesh.parts[part], faces);
      }
      if (std::any_of(facets.begin(), facets.end(),
                      [&](const auto &facet) {
                         return faces.count(facet.first) > 0 &&
                                deformable.count(facet.first) == 0;
                      }))
      {
         touching.insert(body.parts.begin(), body.parts.end());
      }
   }
   return touching;
}

void ThickenShells(const std::set<int> &parts, FebMesh &mesh)
{
   const auto facets = FacetsOfPairs(mesh);
   for (const int part : parts)
   {
      if (mesh.parts[part].shape->dimension == surface_dimension &&
          !mesh.parts[part].cells.empty())
      {
         Thicken(facets, mesh.parts[part], mesh);
      }
   }
}

} // namespace synovia
