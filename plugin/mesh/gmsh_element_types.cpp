#include "synovia/mesh/gmsh_element_types.hpp"

#include "mfem/mesh/gmsh.hpp"

#include <map>

namespace synovia
{

using namespace mfem;

namespace
{
struct Family
{
   Geometry::Type geometry;
   std::string name;
   /// The types of orders 1, 2, ...
   std::vector<int> complete;
   /// The one of order 2 without nodes within faces, and how many it has.
   int serendipity;
   int serendipity_nodes;
};

// As the format's documentation and gmsh's header GmshDefines.h number them.
const std::vector<Family> &Families()
{
   static const std::vector<Family> families{
      {Geometry::POINT, "Point", {15}, 0, 0},
      {Geometry::SEGMENT, "Line", {1, 8, 26, 27, 28, 62, 63, 64, 65, 66}, 0, 0},
      {Geometry::TRIANGLE,
       "Triangle",
       {2, 9, 21, 23, 25, 42, 43, 44, 45, 46},
       0,
       0},
      {Geometry::SQUARE,
       "Quadrilateral",
       {3, 10, 36, 37, 38, 47, 48, 49, 50, 51},
       16,
       8},
      {Geometry::TETRAHEDRON,
       "Tetrahedron",
       {4, 11, 29, 30, 31, 71, 72, 73, 74, 75},
       0,
       0},
      {Geometry::CUBE,
       "Hexahedron",
       {5, 12, 92, 93, 94, 95, 96, 97, 98},
       17,
       20},
      {Geometry::PRISM,
       "Prism",
       {6, 13, 90, 91, 106, 107, 108, 109, 110},
       18,
       15},
      {Geometry::PYRAMID,
       "Pyramid",
       {7, 14, 118, 119, 120, 121, 122, 123, 124},
       19,
       13}};
   return families;
}

int NodesOf(Geometry::Type geometry, int p)
{
   const int edge = p + 1;
   const int triangle = edge * (p + 2) / 2;
   switch (geometry)
   {
   case Geometry::POINT:
      return 1;
   case Geometry::SEGMENT:
      return edge;
   case Geometry::TRIANGLE:
      return triangle;
   case Geometry::SQUARE:
      return edge * edge;
   case Geometry::TETRAHEDRON:
      return triangle * (p + 3) / 3;
   case Geometry::CUBE:
      return edge * edge * edge;
   case Geometry::PRISM:
      return edge * triangle;
   default: // a pyramid's layers are squares
      return triangle * (2 * p + 3) / 3;
   }
}

std::map<int, GmshElementType> MakeTypes()
{
   std::map<int, GmshElementType> types;
   for (const Family &family : Families())
   {
      GmshElementType type;
      type.geometry = family.geometry;
      type.dimension = Geometry::Dimension[family.geometry];
      type.corners = Geometry::NumVerts[family.geometry];
      const auto add = [&](int number, int order, int nodes)
      {
         type.order = order;
         type.nodes = nodes;
         type.name = family.name + " " + std::to_string(nodes);
         types[number] = type;
      };
      int order = 0;
      for (const int number : family.complete)
      {
         order++;
         add(number, order, NodesOf(family.geometry, order));
      }
      if (family.serendipity > 0)
      {
         type.serendipity = true;
         add(family.serendipity, 2, family.serendipity_nodes);
      }
   }
   return types;
}
} // namespace

const GmshElementType &GmshType(int number)
{
   static const std::map<int, GmshElementType> types = MakeTypes();
   static const GmshElementType none;
   const auto found = types.find(number);
   return found == types.end() ? none : found->second;
}

std::vector<int> GmshNodesOfLattice(Geometry::Type geometry, int order)
{
   std::vector<int> nodes(NodesOf(geometry, order));
   switch (geometry)
   {
   case Geometry::TETRAHEDRON:
      GmshHOTetrahedronMapping(order, nodes.data());
      break;
   case Geometry::CUBE:
      GmshHOHexahedronMapping(order, nodes.data());
      break;
   case Geometry::PRISM:
      GmshHOWedgeMapping(order, nodes.data());
      break;
   case Geometry::PYRAMID:
      GmshHOPyramidMapping(order, nodes.data());
      break;
   default:
      MFEM_ABORT("no volume element: geometry " << geometry);
   }
   return nodes;
}

} // namespace synovia
