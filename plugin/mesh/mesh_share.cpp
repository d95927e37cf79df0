#include "synovia/mesh/mesh_share.hpp"
#include "synovia/general/error.hpp"

#include <numeric>
#include <sstream>

namespace synovia
{

using namespace mfem;

namespace
{
std::string TooManyRanks(int ranks, int elements)
{
   return "there are " + std::to_string(ranks) + " ranks and only " +
          std::to_string(elements) +
          " elements; use fewer ranks or refine the mesh";
}

std::string CheckNames(const std::string &kind, const NameTable &names,
                       const Array<int> &present)
{
   for (const auto &entry : names)
   {
      for (const int attribute : entry.second)
      {
         if (present.Find(attribute) < 0)
         {
            return "the " + kind + " \"" + entry.first +
                   "\" stands for attribute " + std::to_string(attribute) +
                   ", which no " + kind + " element of the mesh has";
         }
      }
   }
   return "";
}

std::string CheckPartitioning(const Mesh &serial, int ranks,
                              const std::vector<int> &partitioning)
{
   MFEM_VERIFY(partitioning.empty() ||
                  static_cast<int>(partitioning.size()) == serial.GetNE(),
               "a rank is needed for each element");
   for (std::size_t i = 0; i < partitioning.size(); i++)
   {
      if (partitioning[i] < 0 || partitioning[i] >= ranks)
      {
         return "the partitioning gives element " + std::to_string(i) +
                " to rank " + std::to_string(partitioning[i]) +
                "; the ranks are 0 to " + std::to_string(ranks - 1);
      }
   }
   return "";
}

// The error in the arguments of ScatterMesh(); empty if there is none.
std::string Check(const Mesh &serial, const NameTable &regions,
                  const NameTable &boundaries, int ranks,
                  const std::vector<int> &partitioning)
{
   if (serial.Dimension() != 3 || serial.SpaceDimension() != 3)
   {
      return "the mesh is " + std::to_string(serial.Dimension()) +
             "-dimensional; a three-dimensional one is needed";
   }
   if (ranks > serial.GetNE())
   {
      return TooManyRanks(ranks, serial.GetNE());
   }
   if (serial.attributes.Min() < 1 ||
       (!serial.bdr_attributes.IsEmpty() && serial.bdr_attributes.Min() < 1))
   {
      return "the mesh has an attribute below 1";
   }
   std::string message = CheckNames("region", regions, serial.attributes);
   if (message.empty())
   {
      message = CheckNames("boundary", boundaries, serial.bdr_attributes);
   }
   if (message.empty())
   {
      message = CheckPartitioning(serial, ranks, partitioning);
   }
   return message;
}

Array<int> Broadcast(const Array<int> &attributes, MPI_Comm comm)
{
   std::vector<int> list(attributes.begin(), attributes.end());
   BroadcastList(list, comm);
   Array<int> all;
   for (const int attribute : list)
   {
      all.Append(attribute);
   }
   return all;
}

std::string FindPyramids(const Mesh &mesh)
{
   return mesh.HasGeometry(Geometry::PYRAMID)
             ? "pyramids can't be split; refine the mesh where it is made"
             : "";
}
} // namespace

void VerifyRanks(int ranks, int elements)
{
   if (ranks > elements)
   {
      throw Error(TooManyRanks(ranks, elements));
   }
}

std::vector<char> TextOfShare(const MeshPartitioner &partitioner, int rank)
{
   MeshPart part;
   partitioner.ExtractPart(rank, part);
   std::ostringstream text;
   text.precision(17);
   part.Print(text);
   const std::string all = text.str();
   return std::vector<char>(all.begin(), all.end());
}

std::unique_ptr<ParMesh> JoinShares(const std::vector<char> &text,
                                    MPI_Comm comm)
{
   std::istringstream stream(std::string(text.begin(), text.end()));
   // Elements keep the order of their vertices: tetrahedra are marked already,
   // and tangled elements are not to be turned around.
   constexpr bool mark = false;
   constexpr int with_edges = 1;
   constexpr bool turn = false;
   return std::make_unique<ParMesh>(comm, stream, mark, with_edges, turn);
}

MeshShare ScatterMesh(Mesh &serial, const NameTable &regions,
                      const NameTable &boundaries, MPI_Comm comm,
                      std::vector<int> &partitioning)
{
   int rank = 0;
   int ranks = 1;
   MPI_Comm_rank(comm, &rank);
   MPI_Comm_size(comm, &ranks);
   std::string message;
   std::vector<int> numbers;
   std::unique_ptr<MeshPartitioner> partitioner;
   if (rank == 0)
   {
      message = Check(serial, regions, boundaries, ranks, partitioning);
   }
   ThrowIfAny(comm, message);
   if (rank == 0)
   {
      if (partitioning.empty())
      {
         const std::unique_ptr<int[]> by_metis(
            serial.GeneratePartitioning(ranks));
         partitioning.assign(by_metis.get(), by_metis.get() + serial.GetNE());
      }
      partitioner =
         std::make_unique<MeshPartitioner>(serial, ranks, partitioning.data());
      numbers.resize(serial.GetNE());
      std::iota(numbers.begin(), numbers.end(), 0);
   }
   MeshShare share;
   share.serial_elements = ScatterByElement(numbers, partitioning, comm);
   share.mesh = JoinShares(
      ScatterLists<char>([&](int to) { return TextOfShare(*partitioner, to); },
                         comm),
      comm);
   share.mesh->attributes = Broadcast(serial.attributes, comm);
   share.mesh->bdr_attributes = Broadcast(serial.bdr_attributes, comm);
   return share;
}

std::vector<int> RefineUniformly(MeshShare &share, int times)
{
   constexpr int parts = 8;
   std::vector<int> origins(share.serial_elements.size());
   std::iota(origins.begin(), origins.end(), 0);
   if (times > 0)
   {
      ThrowIfAny(share.mesh->GetComm(), FindPyramids(*share.mesh));
   }
   for (int i = 0; i < times; i++)
   {
      share.mesh->UniformRefinement();
      std::vector<int> next;
      for (const int element : share.serial_elements)
      {
         next.push_back(parts * element);
      }
      share.serial_elements.clear();
      std::vector<int> refined;
      for (const Embedding &part :
           share.mesh->GetRefinementTransforms().embeddings)
      {
         share.serial_elements.push_back(next[part.parent]++);
         refined.push_back(origins[part.parent]);
      }
      origins = std::move(refined);
   }
   return origins;
}

} // namespace synovia
