#pragma once

#include <array>
#include <string>
#include <vector>

namespace synovia
{

/// A type of elements of FEBio.
struct FebShape
{
   std::string name;
   int nodes = 0;
   int corners = 0;
   /// 2 for shells.
   int dimension = 3;
   int order = 1;
   /// The number of the type in MSH files.
   int gmsh_type = 0;
   /// For each node in the order of MSH files its place in FEBio's order.
   std::vector<int> order_in_gmsh;
   /// Corners and middles of edges and of the face itself, by their places.
   std::vector<std::vector<int>> faces;
};

/// The type of that name, or null. Names that add a rule of integration, such
/// as HEX8G6, mean the type without it.
const FebShape *FindFebShape(const std::string &name);

/// Names of all types of bodies, for messages.
std::string FebShapeNames();

/// How many corners a facet of that name has, such as quad8; 0 if there is none
/// of the name.
int FacetCorners(const std::string &name);

} // namespace synovia
