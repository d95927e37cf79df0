#pragma once

#include "synovia/feb/feb_input.hpp"
#include "synovia/feb/feb_shapes.hpp"
#include "synovia/general/point3.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace synovia
{

/// An element by its nodes' places in FebMesh, in FEBio's order.
struct FebCell
{
   long long number;
   std::vector<int> nodes;
};

/// Elements of one type that have one material.
struct FebPart
{
   std::string name;
   const FebShape *shape = nullptr;
   /// The name of the material, or its number; empty until it is known.
   std::string material;
   std::vector<FebCell> cells;
   int line = 0;
};

/// Nodes, elements and sets of a model.
struct FebMesh
{
   std::vector<Point3> nodes;
   /// Their numbers in the file, and back.
   std::vector<long long> numbers;
   std::unordered_map<long long, int> places;
   std::vector<FebPart> parts;
   std::map<std::string, std::vector<int>> node_sets;
   /// Facets by their corners.
   std::map<std::string, std::vector<std::vector<int>>> surfaces;
   /// Ends of springs.
   std::map<std::string, std::vector<std::pair<int, int>>> discrete_sets;
   /// Primary and secondary surface.
   std::map<std::string, std::pair<std::string, std::string>> surface_pairs;
};

/// Reads the section Mesh, which is Geometry in version 2.5.
FebMesh ReadFebMesh(const FebInput &section);

/// Reads the section MeshDomains, which says what parts are made of.
void ReadMeshDomains(const FebInput &section, FebMesh &mesh);

/// The corners of a face in an order that does not depend on the element.
inline std::vector<int> Sorted(std::vector<int> corners)
{
   std::sort(corners.begin(), corners.end());
   return corners;
}

} // namespace synovia
