#include "synovia/general/error.hpp"
#include "synovia/general/text.hpp"
#include "synovia/mesh/contact_partitioning.hpp"
#include "synovia/mesh/flat_mesh.hpp"
#include "synovia/mesh/gmsh_file.hpp"
#include "synovia/mesh/mesh_share.hpp"
#include "synovia/mesh/named_mesh.hpp"
#include "synovia/mesh/shape_mesh.hpp"
#include "synovia/mesh/tangled_elements.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{

std::string Check(const ReadOptions &options)
{
   if (!(std::isfinite(options.scale) && options.scale > 0.0))
   {
      return "the scale is " + ToText(options.scale) + "; it must be positive";
   }
   if (options.refine < 0)
   {
      return "the mesh cannot be refined " + std::to_string(options.refine) +
             " times";
   }
   return "";
}

// Numbers of elements are int.
std::string CheckSize(size_t elements, int refine)
{
   constexpr double most_elements = 2e8;
   const double refined = elements * std::pow(8.0, refine);
   return refined <= most_elements
             ? ""
             : "refined " + std::to_string(refine) + " times it would have " +
                  ToText(refined) + " elements; that is too many";
}

/// A mesh file as rank 0 has it; the others have the names only.
struct FileContents
{
   FlatMesh flat;
   Mesh mesh;
};

// Their elements come last, with the next numbers and no vectors.
void AddShapesTo(FileContents &contents, const std::vector<RigidShape> &shapes)
{
   FlatMesh &flat = contents.flat;
   NamedSerialMesh all =
      AddShapes(contents.mesh, flat.regions, flat.boundaries, shapes);
   contents.mesh = std::move(all.mesh);
   flat.regions = std::move(all.regions);
   flat.boundaries = std::move(all.boundaries);
   long long number = *std::max_element(flat.element_numbers.begin(),
                                        flat.element_numbers.end());
   while (static_cast<int>(flat.element_numbers.size()) < contents.mesh.GetNE())
   {
      flat.element_numbers.push_back(++number);
   }
   number =
      *std::max_element(flat.vertex_numbers.begin(), flat.vertex_numbers.end());
   while (static_cast<int>(flat.vertex_numbers.size()) < contents.mesh.GetNV())
   {
      flat.vertex_numbers.push_back(++number);
   }
   for (auto &entry : flat.element_vectors)
   {
      entry.second.resize(flat.element_numbers.size(), Point3{});
   }
}

void ReadAndBuild(const std::string &file, const ReadOptions &options,
                  FileContents &contents)
{
   FlatMesh &flat = contents.flat;
   flat = ReadGmshFile(file);
   const std::string too_large =
      CheckSize(flat.element_numbers.size(), options.refine);
   if (!too_large.empty())
   {
      throw Error(too_large);
   }
   for (double &x : flat.coordinates)
   {
      x *= options.scale;
   }
   contents.mesh = BuildMesh(flat);
   // The mesh has them.
   flat.coordinates = {};
   flat.element_nodes = {};
   flat.faces = {};
   if (!options.shapes.empty())
   {
      AddShapesTo(contents, options.shapes);
   }
}

FileContents ReadOnRankZero(const std::string &file, MPI_Comm comm,
                            const ReadOptions &options)
{
   int rank = 0;
   MPI_Comm_rank(comm, &rank);
   FileContents contents;
   std::string message;
   if (rank == 0)
   {
      try
      {
         ReadAndBuild(file, options, contents);
      }
      // The other ranks wait: whatever it is must reach them.
      catch (const std::exception &error)
      {
         message = error.what();
      }
   }
   ThrowIfAny(comm, message);
   BroadcastNames(contents.flat, comm);
   return contents;
}

// Numbers of the vertices of each element, before others stand on it.
using CornerNumbers = std::array<long long, 8>;

std::vector<CornerNumbers> NumberCorners(const FlatMesh &flat, Mesh &serial)
{
   std::vector<CornerNumbers> corners(serial.GetNE());
   Array<int> vertices;
   for (int i = 0; i < serial.GetNE(); i++)
   {
      serial.GetElementVertices(i, vertices);
      for (int j = 0; j < vertices.Size(); j++)
      {
         corners[i][j] = flat.vertex_numbers[vertices[j]];
      }
   }
   return corners;
}

// A rank's own, @a corners being of its elements in the order of the mesh.
FileNumbers NumbersOnRank(Mesh &mesh, const std::vector<CornerNumbers> &corners,
                          const std::vector<long long> &elements)
{
   FileNumbers numbers;
   numbers.known = true;
   numbers.elements = elements;
   numbers.vertices.assign(mesh.GetNV(), 0);
   Array<int> vertices;
   for (int i = 0; i < mesh.GetNE(); i++)
   {
      mesh.GetElementVertices(i, vertices);
      for (int j = 0; j < vertices.Size(); j++)
      {
         numbers.vertices[vertices[j]] = corners[i][j];
      }
   }
   return numbers;
}

// Gives each element the value of the one that it is a part of.
template <typename T>
std::vector<T> OfOrigins(const std::vector<T> &values,
                         const std::vector<int> &origins)
{
   std::vector<T> of_parts;
   for (const int origin : origins)
   {
      of_parts.push_back(values[origin]);
   }
   return of_parts;
}

// Splits the elements of the whole mesh, on rank 0, until there is one for each
// rank; says how often.
int RefineForRanks(FileContents &contents, int times, int ranks)
{
   int done = 0;
   // RefineUniformly() says what can't be split.
   const bool can_split = !contents.mesh.HasGeometry(Geometry::PYRAMID);
   for (; can_split && done < times && contents.mesh.GetNE() < ranks; done++)
   {
      contents.mesh.UniformRefinement();
      std::vector<int> origins;
      for (const Embedding &part :
           contents.mesh.GetRefinementTransforms().embeddings)
      {
         origins.push_back(part.parent);
      }
      contents.flat.element_numbers =
         OfOrigins(contents.flat.element_numbers, origins);
      for (auto &entry : contents.flat.element_vectors)
      {
         entry.second = OfOrigins(entry.second, origins);
      }
   }
   return done;
}

NamedMesh Read(const std::string &file, MPI_Comm comm,
               const ReadOptions &options)
{
   ThrowIfAny(comm, Check(options));
   int rank = 0;
   int ranks = 1;
   MPI_Comm_rank(comm, &rank);
   MPI_Comm_size(comm, &ranks);
   FileContents contents = ReadOnRankZero(file, comm, options);
   FlatMesh &flat = contents.flat;
   Mesh &serial = contents.mesh;
   int refined = 0;
   std::vector<int> partitioning;
   if (rank == 0)
   {
      refined = RefineForRanks(contents, options.refine, ranks);
      // Too few elements are an error of ScatterMesh().
      if (!options.contacts.empty() && serial.GetNE() >= ranks)
      {
         partitioning = PartitionByContact(serial, flat.boundaries,
                                           options.contacts, ranks);
      }
   }
   MPI_Bcast(&refined, 1, MPI_INT, 0, comm);
   const bool as_in_file = options.refine == 0;
   std::vector<CornerNumbers> corners;
   if (rank == 0 && as_in_file)
   {
      corners = NumberCorners(flat, serial);
   }
   MeshShare share =
      ScatterMesh(serial, flat.regions, flat.boundaries, comm, partitioning);
   serial.Clear();
   std::vector<long long> numbers =
      ScatterByElement(flat.element_numbers, partitioning, comm);
   ThrowIfTangled(comm, *share.mesh, numbers, flat.regions);
   const std::vector<int> origins =
      RefineUniformly(share, options.refine - refined);
   numbers = OfOrigins(numbers, origins);
   std::map<std::string, ElementVectors> vectors;
   for (const auto &[name, values] : flat.element_vectors)
   {
      vectors[name].vectors =
         OfOrigins(ScatterByElement(values, partitioning, comm), origins);
      vectors[name].numbers = numbers;
   }
   NamedMesh mesh(std::move(share.mesh), flat.regions, flat.boundaries,
                  std::move(share.serial_elements));
   mesh.SetVectors(std::move(vectors));
   if (as_in_file)
   {
      mesh.SetNumbers(NumbersOnRank(
         mesh.Get(), ScatterByElement(corners, partitioning, comm), numbers));
   }
   return mesh;
}

} // namespace

NamedMesh ReadGmsh(const std::string &file, MPI_Comm comm,
                   const ReadOptions &options)
{
   try
   {
      return Read(file, comm, options);
   }
   catch (const Error &error)
   {
      throw Error("mesh \"" + file + "\": " + error.what());
   }
}

} // namespace synovia
