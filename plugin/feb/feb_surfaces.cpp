#include "synovia/feb/feb_surfaces.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

namespace
{
constexpr const char *surface_prefix = "@surface:";
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

FebSurfaces::FebSurfaces(const FebMesh &mesh_, const std::set<int> &deformable,
                         const std::set<int> &rigid)
   : mesh(mesh_), used(mesh_.nodes.size(), false), deforms(used)
{
   struct Face
   {
      int count = 0;
      std::vector<int> nodes;
      size_t corners = 0;
      bool is_rigid = false;
   };
   std::map<std::vector<int>, Face> found;
   std::set<int> parts(deformable);
   parts.insert(rigid.begin(), rigid.end());
   for (const int p : parts)
   {
      const FebPart &part = mesh.parts[p];
      const bool is_rigid_part = rigid.count(p) > 0;
      for (const FebCell &cell : part.cells)
      {
         for (const int node : cell.nodes)
         {
            used[node] = true;
            deforms[node] = deforms[node] || !is_rigid_part;
         }
         for (const std::vector<int> &list : part.shape->faces)
         {
            Face face;
            face.is_rigid = is_rigid_part;
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
         is_rigid.push_back(face.is_rigid);
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

std::vector<int> FebSurfaces::FacesOf(const std::vector<int> &nodes,
                                      std::vector<bool> &left) const
{
   std::vector<bool> wanted(mesh.nodes.size(), false);
   for (const int node : nodes)
   {
      wanted[node] = deforms[node];
   }
   left = wanted;
   std::vector<int> members;
   for (size_t i = 0; i < faces.size(); i++)
   {
      if (!is_rigid[i] &&
          std::all_of(face_nodes[i].begin(), face_nodes[i].end(),
                      [&](int node) { return wanted[node]; }))
      {
         members.push_back(static_cast<int>(i));
         for (const int node : face_nodes[i])
         {
            left[node] = false;
         }
      }
   }
   return members;
}

bool FebSurfaces::AreFaces(const std::string &set)
{
   const std::vector<int> *nodes = FindNodes(set);
   std::vector<bool> left;
   return nodes && !FacesOf(*nodes, left).empty() &&
          std::count(left.begin(), left.end(), true) == 0;
}

std::string FebSurfaces::OfNodes(const std::string &set, const FebInput &where)
{
   const std::vector<int> *nodes = FindNodes(set);
   if (!nodes)
   {
      where.Stop("there is no set of nodes called \"" + set + "\"");
      return "";
   }
   const auto known = made.find(set);
   if (known != made.end())
   {
      return known->second;
   }
   if (set.rfind(surface_prefix, 0) == 0)
   {
      const std::string name = set.substr(std::string(surface_prefix).size());
      const std::vector<int> all = Members(name, true, where);
      const std::vector<int> members = Members(name, false, where);
      if (members.empty() && !all.empty())
      {
         where.IgnoreAll("none of its nodes belongs to a deformable solid");
      }
      return members.size() == all.size() ? OfFacets(name, where)
             : members.empty()            ? ""
                               : Add(set + " that deforms", name, members);
   }

   std::vector<bool> left;
   const std::vector<int> members = FacesOf(*nodes, left);
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

std::vector<int> FebSurfaces::Members(const std::string &surface,
                                      bool with_rigid, const FebInput &where)
{
   const std::vector<std::vector<int>> &facets = mesh.surfaces.at(surface);
   std::vector<int> members;
   size_t inner = 0;
   for (const std::vector<int> &facet : facets)
   {
      const auto face = by_corners.find(Sorted(facet));
      if (face == by_corners.end())
      {
         inner++;
      }
      else if (with_rigid || !is_rigid[face->second])
      {
         members.push_back(face->second);
      }
   }
   if (inner > 0 || facets.empty())
   {
      where.Stop(std::to_string(inner) + " of the " +
                 std::to_string(facets.size()) + " facets of \"" + surface +
                 "\" are no outer faces of deformable solids");
      return {};
   }
   return members;
}

std::string FebSurfaces::OfFacets(const std::string &surface,
                                  const FebInput &where)
{
   if (mesh.surfaces.count(surface) == 0)
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
   const std::vector<int> members = Members(surface, true, where);
   return members.empty() ? "" : Add(key, surface, members);
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
