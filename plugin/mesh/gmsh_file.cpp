#include "synovia/mesh/gmsh_file.hpp"
#include "synovia/general/error.hpp"
#include "synovia/mesh/element_orientation.hpp"
#include "synovia/mesh/face_sides.hpp"
#include "synovia/mesh/gmsh_element_types.hpp"
#include "synovia/mesh/gmsh_shapes.hpp"
#include "synovia/mesh/group_attributes.hpp"
#include "synovia/mesh/msh_contents.hpp"

#include <algorithm>
#include <iterator>

namespace synovia
{

using namespace mfem;

namespace
{

// Counts the cells that are not as they should be, and keeps the first one.
struct Culprits
{
   long long count = 0;
   const MshCell *first = nullptr;

   void Add(const MshCell &cell)
   {
      first = count == 0 ? &cell : first;
      count++;
   }
   std::string Number() const { return std::to_string(first->number); }
};

std::vector<int> Union(const std::vector<int> &a, const std::vector<int> &b)
{
   std::vector<int> both;
   std::set_union(a.begin(), a.end(), b.begin(), b.end(),
                  std::back_inserter(both));
   return both;
}

// The corners of a cell, ascending after as many -1 as it has fewer than 8.
std::array<int, 8> SortedCorners(const MshCells &cells, const MshCell &cell)
{
   std::array<int, 8> corners;
   corners.fill(-1);
   const auto from = cells.nodes.begin() + cell.first;
   std::copy(from, from + GmshType(cell.type).corners, corners.begin());
   std::sort(corners.begin(), corners.end());
   return corners;
}

// Version 2 repeats an element for every group that it is in: leaves one, in
// all the groups.
void MergeDoubles(MshCells &cells)
{
   std::vector<std::pair<std::array<int, 8>, size_t>> keys;
   for (size_t i = 0; i < cells.list.size(); i++)
   {
      keys.emplace_back(SortedCorners(cells, cells.list[i]), i);
   }
   std::sort(keys.begin(), keys.end());
   std::map<std::vector<int>, int> places;
   std::vector<char> keep(cells.list.size(), 1);
   for (size_t i = 1; i < keys.size(); i++)
   {
      if (keys[i - 1].first != keys[i].first)
      {
         continue;
      }
      const MshCell &twin = cells.list[keys[i - 1].second];
      MshCell &cell = cells.list[keys[i].second];
      const std::vector<int> groups =
         Union(cells.groups[twin.groups], cells.groups[cell.groups]);
      const int next = static_cast<int>(cells.groups.size());
      const auto place = places.emplace(groups, next);
      if (place.second)
      {
         cells.groups.push_back(groups);
      }
      cell.groups = place.first->second;
      keep[keys[i - 1].second] = 0;
   }
   size_t kept = 0;
   for (size_t i = 0; i < keep.size(); i++)
   {
      if (keep[i])
      {
         cells.list[kept++] = cells.list[i];
      }
   }
   cells.list.resize(kept);
}

void CheckVolumes(const MshContents &contents)
{
   const MshCells &cells = contents.volumes;
   if (cells.list.empty())
   {
      throw Error("the mesh has no volume elements, but " +
                  std::to_string(contents.surfaces.list.size()) +
                  " surface elements; is it two-dimensional, or are only its "
                  "surfaces in physical groups?");
   }
   for (const MshCell &cell : cells.list)
   {
      const std::string element = "element " + std::to_string(cell.number);
      const GmshElementType &type = GmshType(cell.type);
      const auto corners = SortedCorners(cells, cell);
      const auto first = corners.end() - type.corners;
      if (std::adjacent_find(first, corners.end()) != corners.end())
      {
         throw Error(element + " has the same node at two corners");
      }
   }
}

// Sets the shapes; returns for each the order of its nodes in a mirror.
std::vector<std::vector<int>> SetShapes(const MshCells &cells, FlatMesh &flat)
{
   std::vector<std::vector<int>> mirrored;
   std::map<int, int> places;
   for (const MshCell &cell : cells.list)
   {
      const auto entry = places.emplace(cell.type, places.size());
      if (entry.second)
      {
         const GmshElementType &type = GmshType(cell.type);
         flat.shapes.push_back({type.geometry, type.order, type.nodes, {}});
         flat.order = std::max(flat.order, type.order);
         mirrored.push_back(MirroredNodes(type));
      }
      flat.element_shapes.push_back(entry.first->second);
   }
   for (const auto &place : places)
   {
      if (flat.order > 1)
      {
         flat.shapes[place.second].basis =
            BasisAtNodalPoints(GmshType(place.first), flat.order);
      }
   }
   return mirrored;
}

// Sets the nodes: the corners of volume elements, then their other nodes.
// Returns the place of each node of the file there, -1 if it is left out.
std::vector<int> SetNodes(const MshContents &contents, FlatMesh &flat)
{
   enum Kind
   {
      unused,
      corner,
      other
   };
   std::vector<Kind> kinds(contents.coordinates.size() / 3, unused);
   for (const MshCell &cell : contents.volumes.list)
   {
      const GmshElementType &type = GmshType(cell.type);
      for (int j = 0; j < type.nodes; j++)
      {
         Kind &kind = kinds[contents.volumes.nodes[cell.first + j]];
         kind = j < type.corners || kind == corner ? corner : other;
      }
   }
   std::vector<int> places(kinds.size(), -1);
   int next = 0;
   for (const Kind kind : {corner, other})
   {
      for (size_t i = 0; i < kinds.size(); i++)
      {
         if (kinds[i] == kind)
         {
            const auto from = contents.coordinates.begin() + 3 * i;
            flat.coordinates.insert(flat.coordinates.end(), from, from + 3);
            places[i] = next++;
            if (kind == corner)
            {
               flat.vertex_numbers.push_back(
                  static_cast<long long>(contents.node_numbers[i]));
            }
         }
      }
      flat.vertices = kind == corner ? next : flat.vertices;
   }
   return places;
}

void SetElements(const MshCells &cells, const std::vector<int> &node_places,
                 FlatMesh &flat)
{
   GroupAttributes attributes(cells.names);
   Culprits without_group;
   for (const MshCell &cell : cells.list)
   {
      flat.element_numbers.push_back(cell.number);
      for (int j = 0; j < GmshType(cell.type).nodes; j++)
      {
         flat.element_nodes.push_back(node_places[cells.nodes[cell.first + j]]);
      }
      const std::vector<int> &groups = cells.groups[cell.groups];
      if (groups.empty())
      {
         without_group.Add(cell);
         continue;
      }
      flat.element_attributes.push_back(attributes.Attribute(groups));
   }
   if (without_group.count > 0)
   {
      throw Error(std::to_string(without_group.count) + " of the " +
                  std::to_string(cells.list.size()) +
                  " volume elements are in no physical group; the first is "
                  "element " +
                  without_group.Number() + " of volume " +
                  std::to_string(without_group.first->entity) +
                  "; put every volume into a physical group");
   }
   flat.regions = attributes.Names();
}

void SetElementVectors(const MshContents &contents, FlatMesh &flat)
{
   for (const auto &[name, of_number] : contents.element_vectors)
   {
      std::vector<Point3> &vectors = flat.element_vectors[name];
      for (const long long number : flat.element_numbers)
      {
         const auto found = of_number.find(number);
         const Point3 none{{0.0, 0.0, 0.0}};
         vectors.push_back(found == of_number.end()
                              ? none
                              : Point3{{found->second[0], found->second[1],
                                        found->second[2]}});
      }
   }
}

// The key of the face that a surface element is; false if not all its corners
// are those of volume elements.
bool FindFace(const MshCells &cells, const MshCell &cell,
              const std::vector<int> &node_places, FaceKey &key)
{
   const int corners = GmshType(cell.type).corners;
   if (corners != 3 && corners != 4)
   {
      return false;
   }
   std::array<int, 4> vertices = {-1, -1, -1, -1};
   for (int j = 0; j < corners; j++)
   {
      vertices[j] = node_places[cells.nodes[cell.first + j]];
      if (vertices[j] < 0)
      {
         return false;
      }
   }
   key = MakeFaceKey(vertices);
   return true;
}

// The physical groups of the outer faces that have any.
std::map<FaceKey, std::vector<int>>
GroupsOfOuterFaces(const MshCells &cells, const std::vector<int> &node_places,
                   const std::vector<FaceSide> &sides)
{
   std::map<FaceKey, std::vector<int>> groups;
   Culprits without_volume;
   for (const MshCell &cell : cells.list)
   {
      const std::vector<int> &in = cells.groups[cell.groups];
      if (in.empty())
      {
         continue;
      }
      FaceSide side = {{-1, -1, -1, -1}, -1, -1};
      const bool found = FindFace(cells, cell, node_places, side.key);
      const auto range =
         std::equal_range(sides.begin(), sides.end(), side, ComesBefore);
      if (!found || range.first == range.second)
      {
         without_volume.Add(cell);
      }
      else if (range.second - range.first == 1)
      {
         groups[side.key] = Union(groups[side.key], in);
      }
   }
   if (without_volume.count > 0)
   {
      const int group = cells.groups[without_volume.first->groups].front();
      throw Error(std::to_string(without_volume.count) +
                  " surface elements are no face of a volume element; the "
                  "first is element " +
                  without_volume.Number() + " in the physical surface \"" +
                  cells.names.at(group) +
                  "\"; is a volume missing, or does the surface not belong to "
                  "the mesh?");
   }
   return groups;
}

void SetFaces(const MshCells &cells, const std::vector<int> &node_places,
              const std::vector<FaceSide> &sides, FlatMesh &flat)
{
   const auto groups = GroupsOfOuterFaces(cells, node_places, sides);
   GroupAttributes attributes(cells.names);
   for (const auto &entry : groups)
   {
      attributes.Attribute(entry.second);
   }
   const int unnamed = attributes.Next();
   const std::vector<int> first = FirstNodes(flat);
   for (size_t i = 0; i < sides.size(); i++)
   {
      const FaceSide &side = sides[i];
      if ((i > 0 && sides[i - 1].key == side.key) ||
          (i + 1 < sides.size() && sides[i + 1].key == side.key))
      {
         continue;
      }
      const int shape = flat.element_shapes[side.element];
      flat.faces.push_back(FaceVertices(
         flat.shapes[shape].geometry,
         flat.element_nodes.data() + first[side.element], side.face));
      const auto in = groups.find(side.key);
      flat.face_attributes.push_back(
         in == groups.end() ? unnamed : attributes.Attribute(in->second));
   }
   flat.boundaries = attributes.Names();
}

} // namespace

FlatMesh ReadGmshFile(const std::string &path)
{
   MshContents contents = ReadMsh(path);
   CheckVolumes(contents);
   MergeDoubles(contents.volumes);
   FlatMesh flat;
   const auto mirrored = SetShapes(contents.volumes, flat);
   const std::vector<int> node_places = SetNodes(contents, flat);
   SetElements(contents.volumes, node_places, flat);
   SetElementVectors(contents, flat);
   std::vector<FaceSide> sides = SortedFaceSides(flat);
   if (OrientElements(flat, sides, mirrored) > 0)
   {
      sides = SortedFaceSides(flat);
   }
   SetFaces(contents.surfaces, node_places, sides, flat);
   return flat;
}

} // namespace synovia
