#pragma once

#include "synovia/general/rank_zero_lists.hpp"
#include "synovia/mesh/named_mesh.hpp"

#include <algorithm>
#include <memory>
#include <vector>

namespace synovia
{

/// A rank's share of a mesh, which no rank but rank 0 has ever held whole.
struct MeshShare
{
   std::unique_ptr<mfem::ParMesh> mesh;
   /// For each element of this rank its number in the serial mesh.
   std::vector<int> serial_elements;
};

/// Collective. Sends each rank its elements of @a serial, which counts on rank
/// 0 only, as does @a partitioning, the rank of each element; METIS sets it if
/// it is empty. Names count on all ranks. Throws Error as DistributeMesh()
/// does, but on tangled elements.
MeshShare ScatterMesh(mfem::Mesh &serial, const NameTable &regions,
                      const NameTable &boundaries, MPI_Comm comm,
                      std::vector<int> &partitioning);

/// Throws Error if some ranks would have no element.
void VerifyRanks(int ranks, int elements);

/// A rank's share of a mesh as text, MFEM's format of parallel meshes. The mesh
/// may lack elements that have no vertex in common with that share, if those it
/// has, and the vertices, follow each other in the same order on all ranks.
std::vector<char> TextOfShare(const mfem::MeshPartitioner &partitioner,
                              int rank);

/// Collective. The mesh of which each rank has the text of its share.
std::unique_ptr<mfem::ParMesh> JoinShares(const std::vector<char> &text,
                                          MPI_Comm comm);

/// Collective. The values of this rank's elements, of which rank 0 has one for
/// each element of the serial mesh, by its @a partitioning.
template <typename T>
std::vector<T> ScatterByElement(const std::vector<T> &values,
                                const std::vector<int> &partitioning,
                                MPI_Comm comm)
{
   std::vector<std::vector<int>> elements;
   for (std::size_t i = 0; i < values.size(); i++)
   {
      const auto rank = static_cast<std::size_t>(partitioning[i]);
      elements.resize(std::max(elements.size(), rank + 1));
      elements[rank].push_back(static_cast<int>(i));
   }
   return ScatterLists<T>(
      [&](int to)
      {
         std::vector<T> part;
         if (to < static_cast<int>(elements.size()))
         {
            for (const int i : elements[to])
            {
               part.push_back(values[i]);
            }
         }
         return part;
      },
      comm);
}

/// Collective. Splits every element so many times; each rank splits its own.
/// The numbers of the new elements are the same on any number of ranks: parts
/// of an element follow each other. Gives for each new element of this rank the
/// former one, from 0, that it is a part of. Throws Error if there are
/// pyramids.
std::vector<int> RefineUniformly(MeshShare &share, int times);

} // namespace synovia
