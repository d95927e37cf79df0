#include "synovia/mesh/flat_mesh.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/rank_zero_lists.hpp"
#include "synovia/general/text.hpp"
#include "synovia/mesh/element_nodes.hpp"

namespace synovia
{

using namespace mfem;

namespace
{

void BroadcastNames(NameTable &names, MPI_Comm comm)
{
   int count = static_cast<int>(names.size());
   MPI_Bcast(&count, 1, MPI_INT, 0, comm);
   NameTable received;
   auto entry = names.begin();
   for (int i = 0; i < count; i++)
   {
      std::vector<char> name;
      std::vector<int> attributes;
      if (entry != names.end())
      {
         name.assign(entry->first.begin(), entry->first.end());
         attributes = entry->second;
         ++entry;
      }
      BroadcastList(name, comm);
      BroadcastList(attributes, comm);
      received[std::string(name.begin(), name.end())] = attributes;
   }
   names = std::move(received);
}

void AddElements(const FlatMesh &flat, Mesh &mesh)
{
   int first = 0;
   for (size_t i = 0; i < flat.element_shapes.size(); i++)
   {
      const ElementShape &shape = flat.shapes[flat.element_shapes[i]];
      Element *const element = mesh.NewElement(shape.geometry);
      element->SetVertices(flat.element_nodes.data() + first);
      element->SetAttribute(flat.element_attributes[i]);
      mesh.AddElement(element);
      first += shape.nodes;
   }
   for (size_t i = 0; i < flat.faces.size(); i++)
   {
      const std::array<int, 4> &face = flat.faces[i];
      Element *const element =
         mesh.NewElement(face[3] < 0 ? Geometry::TRIANGLE : Geometry::SQUARE);
      element->SetVertices(face.data());
      element->SetAttribute(flat.face_attributes[i]);
      mesh.AddBdrElement(element);
   }
}

// Row i of positions: the position of MFEM's nodal point i of an element.
void CurvedPositions(const FlatMesh &flat, const ElementShape &shape,
                     const int *nodes, DenseMatrix &positions)
{
   const int points = static_cast<int>(shape.basis.size()) / shape.nodes;
   positions.SetSize(points, 3);
   positions = 0.0;
   for (int i = 0; i < points; i++)
   {
      for (int j = 0; j < shape.nodes; j++)
      {
         const double value = shape.basis[i * shape.nodes + j];
         for (int d = 0; d < 3; d++)
         {
            positions(i, d) += value * flat.coordinates[3 * nodes[j] + d];
         }
      }
   }
}

void Curve(const FlatMesh &flat, Mesh &mesh)
{
   std::vector<int> first(flat.element_shapes.size());
   for (size_t i = 1; i < first.size(); i++)
   {
      first[i] = first[i - 1] + flat.shapes[flat.element_shapes[i - 1]].nodes;
   }
   const auto positions_of = [&](int element, DenseMatrix &positions)
   {
      const ElementShape &shape = flat.shapes[flat.element_shapes[element]];
      CurvedPositions(flat, shape, flat.element_nodes.data() + first[element],
                      positions);
   };
   const int misfit = SetElementNodes(mesh, flat.order, positions_of);
   if (misfit >= 0)
   {
      throw Error("the curved elements do not fit together: element " +
                  std::to_string(flat.element_numbers[misfit]) +
                  " and a neighbor differ on their common face or edge; "
                  "save the mesh with elements of one order, and complete ones "
                  "(Mesh.SecondOrderIncomplete = 0)");
   }
}

} // namespace

void BroadcastNames(FlatMesh &mesh, MPI_Comm comm)
{
   BroadcastNames(mesh.regions, comm);
   BroadcastNames(mesh.boundaries, comm);
   NameTable vectors;
   for (const auto &entry : mesh.element_vectors)
   {
      vectors[entry.first];
   }
   BroadcastNames(vectors, comm);
   for (const auto &entry : vectors)
   {
      mesh.element_vectors[entry.first];
   }
}

Mesh BuildMesh(const FlatMesh &flat)
{
   Mesh mesh(3, flat.vertices, static_cast<int>(flat.element_shapes.size()),
             static_cast<int>(flat.faces.size()), 3);
   for (int i = 0; i < flat.vertices; i++)
   {
      mesh.AddVertex(flat.coordinates[3 * i], flat.coordinates[3 * i + 1],
                     flat.coordinates[3 * i + 2]);
   }
   AddElements(flat, mesh);
   mesh.FinalizeTopology(false);
   if (flat.order > 1)
   {
      Curve(flat, mesh);
   }
   // Marks the edges that refinement splits, which renumbers tetrahedra.
   mesh.Finalize(true, false);
   return mesh;
}

} // namespace synovia
