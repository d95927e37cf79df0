#include "synovia/general/error.hpp"
#include "synovia/mesh/named_mesh.hpp"
#include "synovia/mesh/tangled_elements.hpp"

namespace synovia
{

using namespace mfem;

namespace
{

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
                              const int *partitioning)
{
   for (int i = 0; partitioning && i < serial.GetNE(); i++)
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

// The error in the arguments of DistributeMesh(); empty if there is none.
std::string Check(const Mesh &serial, const NameTable &regions,
                  const NameTable &boundaries, int ranks,
                  const int *partitioning)
{
   if (serial.Dimension() != 3 || serial.SpaceDimension() != 3)
   {
      return "the mesh is " + std::to_string(serial.Dimension()) +
             "-dimensional; a three-dimensional one is needed";
   }
   if (ranks > serial.GetNE())
   {
      return "there are " + std::to_string(ranks) + " ranks and only " +
             std::to_string(serial.GetNE()) +
             " elements; use fewer ranks or refine the mesh";
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

} // namespace

NamedMesh DistributeMesh(Mesh &serial, NameTable regions, NameTable boundaries,
                         MPI_Comm comm, const int *partitioning)
{
   int rank = 0;
   int ranks = 1;
   MPI_Comm_rank(comm, &rank);
   MPI_Comm_size(comm, &ranks);
   ThrowIfAny(comm, Check(serial, regions, boundaries, ranks, partitioning));

   std::unique_ptr<int[]> by_metis;
   if (!partitioning)
   {
      by_metis.reset(serial.GeneratePartitioning(ranks));
      partitioning = by_metis.get();
   }
   std::vector<int> mine;
   for (int i = 0; i < serial.GetNE(); i++)
   {
      if (partitioning[i] == rank)
      {
         mine.push_back(i);
      }
   }
   const auto same = [](int element) { return element; };
   ThrowIfTangled(comm, serial, mine, same, regions);

   auto mesh = std::make_unique<ParMesh>(comm, serial, partitioning);
   return NamedMesh(std::move(mesh), std::move(regions), std::move(boundaries),
                    std::move(mine));
}

} // namespace synovia
