#include "synovia/mesh/flat_mesh.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/text.hpp"
#include "synovia/mesh/element_nodes.hpp"

namespace synovia
{

using namespace mfem;

namespace
{

static_assert(sizeof(std::array<int, 4>) == 4 * sizeof(int),
              "faces are sent as bytes");

// For the types whose bytes may be copied. The ranks of one run are taken to
// agree on the sizes and the order of bytes.
template <typename T>
void BroadcastArray(std::vector<T> &values, MPI_Comm comm)
{
   long long size = values.size();
   MPI_Bcast(&size, 1, MPI_LONG_LONG, 0, comm);
   values.resize(size);
   // MPI counts in int.
   const long long most = (1 << 30) / static_cast<long long>(sizeof(T));
   for (long long i = 0; i < size; i += most)
   {
      const long long count = std::min(most, size - i);
      MPI_Bcast(values.data() + i, static_cast<int>(count * sizeof(T)),
                MPI_BYTE, 0, comm);
   }
}

void BroadcastNumber(int &value, MPI_Comm comm)
{
   MPI_Bcast(&value, 1, MPI_INT, 0, comm);
}

void BroadcastNames(NameTable &names, MPI_Comm comm)
{
   int count = static_cast<int>(names.size());
   BroadcastNumber(count, comm);
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
      BroadcastArray(name, comm);
      BroadcastArray(attributes, comm);
      received[std::string(name.begin(), name.end())] = attributes;
   }
   names = std::move(received);
}

void BroadcastVectors(std::map<std::string, std::vector<Point3>> &vectors,
                      MPI_Comm comm)
{
   // As tables of names are sent, in the order of the names.
   NameTable names;
   for (const auto &entry : vectors)
   {
      names[entry.first];
   }
   BroadcastNames(names, comm);
   for (const auto &entry : names)
   {
      BroadcastArray(vectors[entry.first], comm);
   }
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

void Broadcast(FlatMesh &mesh, MPI_Comm comm)
{
   BroadcastNumber(mesh.order, comm);
   int shapes = static_cast<int>(mesh.shapes.size());
   BroadcastNumber(shapes, comm);
   mesh.shapes.resize(shapes);
   for (ElementShape &shape : mesh.shapes)
   {
      int geometry = shape.geometry;
      BroadcastNumber(geometry, comm);
      shape.geometry = static_cast<Geometry::Type>(geometry);
      BroadcastNumber(shape.order, comm);
      BroadcastNumber(shape.nodes, comm);
      BroadcastArray(shape.basis, comm);
   }
   BroadcastArray(mesh.coordinates, comm);
   BroadcastNumber(mesh.vertices, comm);
   BroadcastArray(mesh.element_shapes, comm);
   BroadcastArray(mesh.element_attributes, comm);
   BroadcastArray(mesh.element_numbers, comm);
   BroadcastArray(mesh.element_nodes, comm);
   BroadcastVectors(mesh.element_vectors, comm);
   BroadcastArray(mesh.faces, comm);
   BroadcastArray(mesh.face_attributes, comm);
   BroadcastNames(mesh.regions, comm);
   BroadcastNames(mesh.boundaries, comm);
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
