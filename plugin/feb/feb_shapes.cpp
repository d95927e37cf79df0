#include "synovia/feb/feb_shapes.hpp"

#include <algorithm>
#include <cctype>
#include <numeric>

namespace synovia
{

namespace
{
using Edge = std::array<int, 2>;
using Lists = std::vector<std::vector<int>>;

/// Corners and edges of a solid in the order of FEBio's manual, and its edges
/// in that of gmsh.
struct Solid
{
   int corners;
   std::vector<Edge> edges;
   std::vector<Edge> gmsh_edges;
   Lists faces;
};

const Solid &Hexahedron()
{
   static const Solid solid{8,
                            {{0, 1},
                             {1, 2},
                             {2, 3},
                             {3, 0},
                             {4, 5},
                             {5, 6},
                             {6, 7},
                             {7, 4},
                             {0, 4},
                             {1, 5},
                             {2, 6},
                             {3, 7}},
                            {{0, 1},
                             {0, 3},
                             {0, 4},
                             {1, 2},
                             {1, 5},
                             {2, 3},
                             {2, 6},
                             {3, 7},
                             {4, 5},
                             {4, 7},
                             {5, 6},
                             {6, 7}},
                            {{0, 1, 5, 4},
                             {1, 2, 6, 5},
                             {2, 3, 7, 6},
                             {3, 0, 4, 7},
                             {0, 3, 2, 1},
                             {4, 5, 6, 7}}};
   return solid;
}

const Solid &Tetrahedron()
{
   static const Solid solid{4,
                            {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}},
                            {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {2, 3}, {1, 3}},
                            {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {2, 1, 0}}};
   return solid;
}

const Solid &Prism()
{
   static const Solid solid{
      6,
      {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}},
      {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 4}, {2, 5}, {3, 4}, {3, 5}, {4, 5}},
      {{0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}, {0, 2, 1}, {3, 4, 5}}};
   return solid;
}

// The place of an edge, whichever way it runs.
int FindEdge(const std::vector<Edge> &edges, int a, int b)
{
   const auto is_it = [&](const Edge &edge)
   { return (edge[0] == a && edge[1] == b) || (edge[0] == b && edge[1] == a); };
   const auto found = std::find_if(edges.begin(), edges.end(), is_it);
   return static_cast<int>(found - edges.begin());
}

FebShape Linear(const std::string &name, const Solid &solid, int gmsh_type)
{
   FebShape shape;
   shape.name = name;
   shape.nodes = shape.corners = solid.corners;
   shape.gmsh_type = gmsh_type;
   shape.order_in_gmsh.resize(solid.corners);
   std::iota(shape.order_in_gmsh.begin(), shape.order_in_gmsh.end(), 0);
   shape.faces = solid.faces;
   return shape;
}

// With a node in the middle of each edge.
FebShape Quadratic(const std::string &name, const Solid &solid, int gmsh_type)
{
   FebShape shape = Linear(name, solid, gmsh_type);
   shape.order = 2;
   shape.nodes += static_cast<int>(solid.edges.size());
   for (const Edge &edge : solid.gmsh_edges)
   {
      shape.order_in_gmsh.push_back(solid.corners +
                                    FindEdge(solid.edges, edge[0], edge[1]));
   }
   for (std::vector<int> &face : shape.faces)
   {
      const size_t corners = face.size();
      for (size_t i = 0; i < corners; i++)
      {
         face.push_back(solid.corners + FindEdge(solid.edges, face[i],
                                                 face[(i + 1) % corners]));
      }
   }
   return shape;
}

// With a node in the middle of each face and of the body, too.
FebShape CompleteHexahedron()
{
   FebShape shape = Quadratic("hex27", Hexahedron(), 12);
   const int first = shape.nodes;
   for (size_t i = 0; i < shape.faces.size(); i++)
   {
      shape.faces[i].push_back(first + static_cast<int>(i));
   }
   shape.nodes = 27;
   // gmsh has bottom, front, left, right, back, top, middle.
   for (const int face : {4, 0, 3, 1, 2, 5, 6})
   {
      shape.order_in_gmsh.push_back(first + face);
   }
   return shape;
}

FebShape Shell(const std::string &name, int nodes, int corners)
{
   FebShape shape;
   shape.name = name;
   shape.nodes = nodes;
   shape.corners = corners;
   shape.dimension = 2;
   return shape;
}

const std::vector<FebShape> &Shapes()
{
   static const std::vector<FebShape> shapes{
      Linear("hex8", Hexahedron(), 5),
      Quadratic("hex20", Hexahedron(), 17),
      CompleteHexahedron(),
      Linear("tet4", Tetrahedron(), 4),
      Quadratic("tet10", Tetrahedron(), 11),
      Linear("penta6", Prism(), 6),
      Quadratic("penta15", Prism(), 18),
      Shell("quad4", 4, 4),
      Shell("quad8", 8, 4),
      Shell("tri3", 3, 3),
      Shell("tri6", 6, 3)};
   return shapes;
}
} // namespace

const FebShape *FindFebShape(const std::string &name)
{
   std::string plain(name);
   std::transform(plain.begin(), plain.end(), plain.begin(),
                  [](unsigned char c) { return std::tolower(c); });
   plain = plain.substr(0, plain.find('g'));
   for (const FebShape &shape : Shapes())
   {
      if (shape.name == plain)
      {
         return &shape;
      }
   }
   return nullptr;
}

std::string FebShapeNames()
{
   std::string names;
   for (const FebShape &shape : Shapes())
   {
      if (shape.dimension == 3)
      {
         names += (names.empty() ? "" : ", ") + shape.name;
      }
   }
   return names;
}

int FacetCorners(const std::string &name)
{
   for (const char *triangle : {"tri3", "tri6", "tri7"})
   {
      if (name == triangle)
      {
         return 3;
      }
   }
   for (const char *square : {"quad4", "quad8", "quad9"})
   {
      if (name == square)
      {
         return 4;
      }
   }
   return 0;
}

} // namespace synovia
