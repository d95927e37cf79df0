#include "synovia/contact/surface_vertices.hpp"
#include "synovia/general/parallel_triplets.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
// First of this rank, of the next rank, and the number of all.
HYPRE_BigInt Number(int mine, MPI_Comm comm,
                    std::array<HYPRE_BigInt, 2> &offsets)
{
   const HYPRE_BigInt count = mine;
   HYPRE_BigInt end = 0;
   HYPRE_BigInt all = 0;
   MPI_Scan(&count, &end, 1, HYPRE_MPI_BIG_INT, MPI_SUM, comm);
   MPI_Allreduce(&count, &all, 1, HYPRE_MPI_BIG_INT, MPI_SUM, comm);
   offsets = {end - count, end};
   return all;
}

Vector OnHost(Vector &result)
{
   result.HostReadWrite();
   result.UseDevice(false);
   return std::move(result);
}
} // namespace

SurfaceVertices::SurfaceVertices(BiphasicSpaces &spaces,
                                 const Array<int> &marker)
   : space_size(spaces.Multiplier().GetTrueVSize())
{
   ParFiniteElementSpace &space = spaces.Multiplier();
   const ParMesh &mesh = spaces.GetMesh();
   space.GetEssentialTrueDofs(marker, true_dofs);
   for (int i = 0; i < mesh.GetNBE(); i++)
   {
      if (marker[mesh.GetBdrAttribute(i) - 1])
      {
         Array<int> dofs;
         space.GetBdrElementDofs(i, dofs);
         local_dofs.Append(dofs);
      }
   }
   local_dofs.Sort();
   local_dofs.Unique();
   MPI_Comm comm = spaces.GetComm();
   global_size = Number(Size(), comm, offsets);
   const HYPRE_BigInt all_local = Number(LocalSize(), comm, local_offsets);

   // Numbers below 2^53 are exact.
   Vector number(space_size);
   number = -1.0;
   for (int i = 0; i < Size(); i++)
   {
      number[true_dofs[i]] = static_cast<real_t>(offsets[0] + i);
   }
   Vector number_on_dofs(space.GetVSize());
   space.GetProlongationMatrix()->Mult(number, number_on_dofs);
   number_on_dofs.HostRead();
   std::vector<Triplet> entries;
   for (int i = 0; i < LocalSize(); i++)
   {
      globals.push_back(
         static_cast<HYPRE_BigInt>(number_on_dofs[local_dofs[i]]));
      entries.push_back({local_offsets[0] + i, globals.back(), 1.0});
   }
   prolongation = AssembleTriplets(comm, entries, local_offsets.data(),
                                   all_local, offsets.data(), global_size);
}

Vector SurfaceVertices::SumShared(const Vector &local) const
{
   Vector result(Size());
   prolongation->MultTranspose(Vector(local), result);
   return OnHost(result);
}

Vector SurfaceVertices::Share(const Vector &own) const
{
   Vector result(LocalSize());
   prolongation->Mult(Vector(own), result);
   return OnHost(result);
}

Vector SurfaceVertices::ToTrueDofs(const Vector &own) const
{
   Vector all(space_size);
   all = 0.0;
   for (int i = 0; i < Size(); i++)
   {
      all[true_dofs[i]] = own[i];
   }
   return all;
}

Vector SurfaceVertices::FromTrueDofs(const Vector &all) const
{
   Vector own(Size());
   for (int i = 0; i < Size(); i++)
   {
      own[i] = all[true_dofs[i]];
   }
   return own;
}

} // namespace synovia
