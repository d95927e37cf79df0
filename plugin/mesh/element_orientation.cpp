#include "synovia/mesh/element_orientation.hpp"
#include "synovia/general/error.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

namespace
{

enum class View
{
   same,
   opposite,
   different_edges
};

// How the two sides of a face go around it.
View Compare(std::array<int, 4> a, std::array<int, 4> b)
{
   const int corners = a[3] < 0 ? 3 : 4;
   std::rotate(a.begin(), std::min_element(a.begin(), a.begin() + corners),
               a.begin() + corners);
   std::rotate(b.begin(), std::min_element(b.begin(), b.begin() + corners),
               b.begin() + corners);
   if (a == b)
   {
      return View::same;
   }
   std::reverse(b.begin() + 1, b.begin() + corners);
   return a == b ? View::opposite : View::different_edges;
}

struct Neighbor
{
   int element;
   bool same_view;
};
using NeighborTable = std::vector<std::vector<Neighbor>>;

// Sign of the volume that the edges at the first corner span.
int Handedness(const FlatMesh &mesh, Geometry::Type geometry, const int *nodes)
{
   const bool triangular =
      geometry == Geometry::TETRAHEDRON || geometry == Geometry::PRISM;
   const int y = triangular ? 2 : 3;
   const int ends[3] = {1, y, y + 1};
   double edges[3][3];
   for (int i = 0; i < 3; i++)
   {
      for (int d = 0; d < 3; d++)
      {
         edges[i][d] = mesh.coordinates[3 * nodes[ends[i]] + d] -
                       mesh.coordinates[3 * nodes[0] + d];
      }
   }
   double volume = 0.0;
   for (int d = 0; d < 3; d++)
   {
      const int e = (d + 1) % 3;
      const int f = (d + 2) % 3;
      volume +=
         edges[0][d] * (edges[1][e] * edges[2][f] - edges[1][f] * edges[2][e]);
   }
   return (volume > 0.0) - (volume < 0.0);
}

NeighborTable FindNeighbors(const FlatMesh &mesh, const std::vector<int> &first,
                            const std::vector<FaceSide> &sides)
{
   const auto vertices = [&](const FaceSide &side)
   {
      const int shape = mesh.element_shapes[side.element];
      return FaceVertices(mesh.shapes[shape].geometry,
                          mesh.element_nodes.data() + first[side.element],
                          side.face);
   };
   NeighborTable neighbors(first.size());
   for (size_t i = 1; i < sides.size(); i++)
   {
      const FaceSide &a = sides[i - 1];
      const FaceSide &b = sides[i];
      if (a.key != b.key)
      {
         continue;
      }
      const View view = Compare(vertices(a), vertices(b));
      if (view == View::different_edges)
      {
         throw Error("the elements " +
                     std::to_string(mesh.element_numbers[a.element]) + " and " +
                     std::to_string(mesh.element_numbers[b.element]) +
                     " share the corners of a face but not its edges");
      }
      neighbors[a.element].push_back({b.element, view == View::same});
      neighbors[b.element].push_back({a.element, view == View::same});
   }
   return neighbors;
}

// The elements of a connected body from a seed on, their senses made to agree:
// 1 is as it is, -1 mirrored, 0 not known yet.
std::vector<int> GatherBody(const NeighborTable &neighbors, int seed,
                            std::vector<int> &senses)
{
   senses[seed] = 1;
   std::vector<int> body(1, seed);
   for (size_t i = 0; i < body.size(); i++)
   {
      const int element = body[i];
      for (const Neighbor &next : neighbors[element])
      {
         if (senses[next.element] == 0)
         {
            senses[next.element] =
               next.same_view ? -senses[element] : senses[element];
            body.push_back(next.element);
         }
      }
   }
   return body;
}

std::vector<int> FindSenses(const FlatMesh &mesh, const std::vector<int> &first,
                            const NeighborTable &neighbors)
{
   const int elements = static_cast<int>(first.size());
   std::vector<int> senses(elements, 0);
   for (int seed = 0; seed < elements; seed++)
   {
      if (senses[seed] != 0)
      {
         continue;
      }
      const std::vector<int> body = GatherBody(neighbors, seed, senses);
      long long balance = 0;
      for (const int element : body)
      {
         const ElementShape &shape = mesh.shapes[mesh.element_shapes[element]];
         const int *const nodes = mesh.element_nodes.data() + first[element];
         balance += senses[element] * Handedness(mesh, shape.geometry, nodes);
      }
      for (const int element : body)
      {
         senses[element] = balance < 0 ? -senses[element] : senses[element];
      }
   }
   return senses;
}

} // namespace

int OrientElements(FlatMesh &mesh, const std::vector<FaceSide> &sides,
                   const std::vector<std::vector<int>> &mirrored)
{
   const std::vector<int> first = FirstNodes(mesh);
   const std::vector<int> senses =
      FindSenses(mesh, first, FindNeighbors(mesh, first, sides));
   int renumbered = 0;
   for (size_t i = 0; i < senses.size(); i++)
   {
      if (senses[i] > 0)
      {
         continue;
      }
      const std::vector<int> &order = mirrored[mesh.element_shapes[i]];
      const auto nodes = mesh.element_nodes.begin() + first[i];
      const std::vector<int> old(nodes, nodes + order.size());
      for (size_t j = 0; j < order.size(); j++)
      {
         nodes[j] = old[order[j]];
      }
      renumbered++;
   }
   return renumbered;
}

} // namespace synovia
