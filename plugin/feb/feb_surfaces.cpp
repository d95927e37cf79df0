#include "synovia/feb/feb_surfaces.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

namespace
{
constexpr const char *surface_prefix = "@surface:";

std::vector<int> Sorted(std::vector<int> list)
{
   std::sort(list.begin(), list.end());
   return list;
}
} // namespace

std::string PlainName(std::string name)
{
   for (char &c : name)
   {
      if (std::string(",\"'/\\").find(c) != std::string::npos)
      {
         c = '_';
      }
   }
   return name.empty() || name[0] == '.' ? "_" + name : name;
}

FebSurfaces::FebSurfaces(const FebMesh &mesh_, const std::set<int> &parts)
   : mesh(mesh_), used(mesh_.nodes.size(), false)
{
   struct Face
   {
      int count = 0;
      std::vector<int> nodes;
      size_t corners = 0;
   };
   std::map<std::vector<int>, Face> found;
   for (const int p : parts)
   {
      const FebPart &part = mesh.parts[p];
      for (const FebCell &cell : part.cells)
      {
         for (const int node : cell.nodes)
         {
            used[node] = true;
         }
         for (const std::vector<int> &list : part.shape->faces)
         {
            Face face;
            for (const int place : list)
            {
               face.nodes.push_back(cell.nodes[place]);
               face.corners += place < part.shape->corners ? 1 : 0;
            }
            const std::vector<int> corners(face.nodes.begin(),
                                           face.nodes.begin() +
                                              static_cast<int>(face.corners));
            Face &entry = found[Sorted(corners)];
            face.count = entry.count + 1;
            entry = face;
         }
      }
   }
   for (const auto &[corners, face] : found)
   {
      if (face.count == 1)
      {
         by_corners[corners] = static_cast<int>(faces.size());
         faces.emplace_back(face.nodes.begin(),
                            face.nodes.begin() +
                               static_cast<int>(face.corners));
         face_nodes.push_back(face.nodes);
      }
   }
}

const std::vector<int> *FebSurfaces::FindNodes(const std::string &set)
{
   if (set.rfind(surface_prefix, 0) != 0)
   {
      const auto found = mesh.node_sets.find(set);
      return found == mesh.node_sets.end() ? nullptr : &found->second;
   }
   const auto surface =
      mesh.surfaces.find(set.substr(std::string(surface_prefix).size()));
   if (surface == mesh.surfaces.end())
   {
      return nullptr;
   }
   std::set<int> nodes;
   for (const std::vector<int> &facet : surface->second)
   {
      const auto face = by_corners.find(Sorted(facet));
      const std::vector<int> &all =
         face == by_corners.end() ? facet : face_nodes[face->second];
      nodes.insert(all.begin(), all.end());
   }
   std::vector<int> &list = nodes_of_surfaces[set];
   list.assign(nodes.begin(), nodes.end());
   return &list;
}

std::string FebSurfaces::OfNodes(const std::string &set, const FebInput &where)
{
   const std::vector<int> *nodes = FindNodes(set);
   if (!nodes)
   {
      where.Stop("there is no set of nodes called \"" + set + "\"");
      return "";
   }
   if (set.rfind(surface_prefix, 0) == 0)
   {
      return OfFacets(set.substr(std::string(surface_prefix).size()), where);
   }
   const auto known = made.find(set);
   if (known != made.end())
   {
      return known->second;
   }
   std::vector<bool> wanted(mesh.nodes.size(), false);
   for (const int node : *nodes)
   {
      wanted[node] = used[node];
   }
   std::vector<bool> left(wanted);
   std::vector<int> members;
   for (size_t i = 0; i < faces.size(); i++)
   {
      if (std::all_of(face_nodes[i].begin(), face_nodes[i].end(),
                      [&](int node) { return wanted[node]; }))
      {
         members.push_back(static_cast<int>(i));
         for (const int node : face_nodes[i])
         {
            left[node] = false;
         }
      }
   }
   const auto rest = std::count(left.begin(), left.end(), true);
   if (rest > 0)
   {
      const auto first = std::find(left.begin(), left.end(), true);
      where.Stop("conditions go with surfaces here, but " +
                 std::to_string(rest) + " of the nodes of \"" + set +
                 "\" are on no outer face whose nodes are all in the set, "
                 "such as node " +
                 std::to_string(mesh.numbers[first - left.begin()]));
      return "";
   }
   if (members.empty())
   {
      where.IgnoreAll("none of its nodes belongs to a deformable solid");
      return "";
   }
   return Add(set, set, members);
}

std::string FebSurfaces::OfFacets(const std::string &surface,
                                  const FebInput &where)
{
   const auto found = mesh.surfaces.find(surface);
   if (found == mesh.surfaces.end())
   {
      where.Stop("there is no surface called \"" + surface + "\"");
      return "";
   }
   const std::string key = surface_prefix + surface;
   const auto known = made.find(key);
   if (known != made.end())
   {
      return known->second;
   }
   std::vector<int> members;
   size_t inner = 0;
   for (const std::vector<int> &facet : found->second)
   {
      const auto face = by_corners.find(Sorted(facet));
      if (face == by_corners.end())
      {
         inner++;
      }
      else
      {
         members.push_back(face->second);
      }
   }
   if (inner > 0 || members.empty())
   {
      where.Stop(std::to_string(inner) + " of the " +
                 std::to_string(found->second.size()) + " facets of \"" +
                 surface + "\" are no outer faces of deformable solids");
      return "";
   }
   return Add(key, surface, members);
}

std::map<int, real_t> FebSurfaces::NodalAreas(const std::string &name) const
{
   std::map<int, real_t> areas;
   for (const Group &group : groups)
   {
      if (group.name != name)
      {
         continue;
      }
      for (const int face : group.faces)
      {
         const std::vector<int> &corners = faces[face];
         const Geometry::Type geometry =
            corners.size() == 3 ? Geometry::TRIANGLE : Geometry::SQUARE;
         DenseMatrix points(3, static_cast<int>(corners.size()));
         for (int i = 0; i < points.Width(); i++)
         {
            points.SetCol(i, mesh.nodes[corners[i]].data());
         }
         IsoparametricTransformation map;
         map.SetIdentityTransformation(geometry);
         map.SetPointMat(points);
         Vector shape(points.Width());
         const IntegrationRule &rule = IntRules.Get(geometry, 4);
         for (const IntegrationPoint &point : rule)
         {
            map.SetIntPoint(&point);
            map.GetFE()->CalcShape(point, shape);
            for (int i = 0; i < shape.Size(); i++)
            {
               areas[corners[i]] += point.weight * map.Weight() * shape[i];
            }
         }
      }
   }
   return areas;
}

std::string FebSurfaces::Unused(const std::string &name) const
{
   const auto is_there = [&](const std::string &candidate)
   {
      return std::any_of(groups.begin(), groups.end(),
                         [&](const Group &group)
                         { return group.name == candidate; }) ||
             std::any_of(mesh.parts.begin(), mesh.parts.end(),
                         [&](const FebPart &part)
                         { return part.name == candidate; });
   };
   std::string unused(name);
   for (int i = 2; is_there(unused); i++)
   {
      unused = name + "_" + std::to_string(i);
   }
   return unused;
}

std::string FebSurfaces::Add(const std::string &key, const std::string &name,
                             const std::vector<int> &members)
{
   const std::string unused = Unused(PlainName(name));
   groups.push_back({unused, members});
   made[key] = unused;
   return unused;
}

} // namespace synovia
