#include "synovia/general/error.hpp"
#include "synovia/general/text.hpp"
#include "synovia/mesh/contact_partitioning.hpp"
#include "synovia/mesh/flat_mesh.hpp"
#include "synovia/mesh/gmsh_file.hpp"
#include "synovia/mesh/named_mesh.hpp"
#include "synovia/mesh/tangled_elements.hpp"

#include <cmath>
#include <numeric>

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

// Every rank holds the whole mesh before it is distributed.
std::string CheckSize(size_t elements, int refine)
{
   constexpr double most_elements = 5e7;
   const double refined = elements * std::pow(8.0, refine);
   return refined <= most_elements
             ? ""
             : "refined " + std::to_string(refine) + " times it would have " +
                  ToText(refined) + " elements; that is too many";
}

FlatMesh ReadOnRankZero(const std::string &file, MPI_Comm comm)
{
   int rank = 0;
   MPI_Comm_rank(comm, &rank);
   FlatMesh flat;
   std::string message;
   if (rank == 0)
   {
      try
      {
         flat = ReadGmshFile(file);
      }
      // The other ranks wait: whatever it is must reach them.
      catch (const std::exception &error)
      {
         message = error.what();
      }
   }
   ThrowIfAny(comm, message);
   Broadcast(flat, comm);
   return flat;
}

// The elements that this rank looks at: an equal share.
std::vector<int> ShareOfElements(const Mesh &mesh, MPI_Comm comm)
{
   int rank = 0;
   int ranks = 1;
   MPI_Comm_rank(comm, &rank);
   MPI_Comm_size(comm, &ranks);
   std::vector<int> share;
   for (int i = rank; i < mesh.GetNE(); i += ranks)
   {
      share.push_back(i);
   }
   return share;
}

// Refines each element, and finds for each of the new ones which element of the
// file it is a part of.
std::vector<int> Refine(Mesh &serial, int times)
{
   std::vector<int> origins(serial.GetNE());
   std::iota(origins.begin(), origins.end(), 0);
   for (int i = 0; i < times; i++)
   {
      serial.UniformRefinement();
      std::vector<int> refined;
      for (const Embedding &part : serial.GetRefinementTransforms().embeddings)
      {
         refined.push_back(origins[part.parent]);
      }
      origins = std::move(refined);
   }
   return origins;
}

// The vectors of this rank's elements.
std::map<std::string, ElementVectors>
LocalVectors(const FlatMesh &flat, const std::vector<int> &origins,
             const NamedMesh &mesh)
{
   std::map<std::string, ElementVectors> local;
   for (const auto &[name, vectors] : flat.element_vectors)
   {
      ElementVectors &own = local[name];
      for (const int element : mesh.SerialElements())
      {
         own.vectors.push_back(vectors[origins[element]]);
         own.numbers.push_back(flat.element_numbers[origins[element]]);
      }
   }
   return local;
}

NamedMesh Read(const std::string &file, MPI_Comm comm,
               const ReadOptions &options)
{
   ThrowIfAny(comm, Check(options));
   FlatMesh flat = ReadOnRankZero(file, comm);
   ThrowIfAny(comm, CheckSize(flat.element_numbers.size(), options.refine));
   for (double &x : flat.coordinates)
   {
      x *= options.scale;
   }
   Mesh serial = BuildMesh(flat);
   // Here, and not only in DistributeMesh(), because of gmsh's numbers.
   ThrowIfTangled(
      comm, serial, ShareOfElements(serial, comm),
      [&](int element) { return flat.element_numbers[element]; }, flat.regions);
   const std::vector<int> origins = Refine(serial, options.refine);
   int ranks = 1;
   MPI_Comm_size(comm, &ranks);
   // Too few elements are an error of DistributeMesh().
   std::vector<int> partitioning;
   if (!options.contacts.empty() && serial.GetNE() >= ranks)
   {
      partitioning =
         PartitionByContact(serial, flat.boundaries, options.contacts, ranks);
   }
   NamedMesh mesh =
      DistributeMesh(serial, flat.regions, flat.boundaries, comm,
                     partitioning.empty() ? nullptr : partitioning.data());
   mesh.SetVectors(LocalVectors(flat, origins, mesh));
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
