#pragma once

#include "synovia/mesh/gmsh_element_types.hpp"

#include <array>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

namespace synovia
{

/// An element of an MSH file.
struct MshCell
{
   /// gmsh's type, and the numbers of the element and of its entity.
   int type;
   long long number;
   int entity;
   /// Where its nodes start in MshCells::nodes.
   size_t first;
   /// Place of its groups in MshCells::groups.
   int groups;
};

/// The elements of one dimension.
struct MshCells
{
   std::vector<MshCell> list;
   /// Places of the nodes: node n is at MshContents::coordinates[3 n].
   std::vector<int> nodes;
   /// The sets of physical groups that there are, each ascending.
   std::vector<std::vector<int>> groups;
   /// All physical groups; one without a name has its tag as name.
   std::map<int, std::string> names;
};

/// The contents of an MSH file.
struct MshContents
{
   /// x, y, z of all nodes.
   std::vector<double> coordinates;
   /// Their numbers, ascending.
   std::vector<size_t> node_numbers;
   MshCells volumes;
   MshCells surfaces;
   /// By the names of views, what $ElementData has of vectors, by the numbers
   /// of elements. Of several time steps the first one that is there.
   std::map<std::string, std::unordered_map<long long, std::array<double, 3>>>
      element_vectors;
};

/// Reads an MSH file of version 2 or 4.1, ascii or binary. Throws Error, whose
/// text gives the place but not the name of the file, if it is no such file or
/// damaged.
///
/// gmsh's own reader is of no use here: it trusts the counts and numbers in a
/// file, so that damaged ones crash it, and in version 2 it takes the physical
/// tags of all elements of an entity together, so that the regions get mixed up
/// where another program has written one entity for all.
MshContents ReadMsh(const std::string &path);

} // namespace synovia
