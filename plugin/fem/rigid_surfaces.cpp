#include "synovia/fem/rigid_surfaces.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/parallel_triplets.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/mesh/boundary_marker.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace synovia
{

using namespace mfem;

namespace
{
Array<int> DrivenDofs(ParFiniteElementSpace &space,
                      const DrivenSurface &surface, int component)
{
   const Array<int> marker =
      BoundaryMarker(*space.GetParMesh(), surface.boundary);
   Array<int> dofs;
   space.GetEssentialTrueDofs(marker, dofs, component);
   return dofs;
}

int LargestComponent(const std::array<real_t, 3> &direction)
{
   int largest = 0;
   for (int d = 1; d < 3; d++)
   {
      if (std::abs(direction[d]) > std::abs(direction[largest]))
      {
         largest = d;
      }
   }
   return largest;
}

// Square, with the order of the space's true dofs.
std::unique_ptr<HypreParMatrix> Square(ParFiniteElementSpace &space,
                                       const std::vector<Triplet> &triplets)
{
   return AssembleTriplets(space.GetComm(), triplets, space.GetTrueDofOffsets(),
                           space.GlobalTrueVSize(), space.GetTrueDofOffsets(),
                           space.GlobalTrueVSize());
}
} // namespace

RigidSurfaces::RigidSurfaces(BiphasicSpaces &spaces,
                             const std::vector<DrivenSurface> &surfaces,
                             const Array<int> &prescribed)
   : comm(spaces.GetComm())
{
   if (surfaces.empty())
   {
      return;
   }
   ParFiniteElementSpace &space = spaces.Displacement();
   const HYPRE_BigInt first = space.GetMyTDofOffset();
   const int size = space.GetTrueVSize();
   std::vector<bool> driven(size, false);
   std::vector<Triplet> map;
   for (const DrivenSurface &surface : surfaces)
   {
      const int axis = LargestComponent(surface.direction);
      const Array<int> along = DrivenDofs(space, surface, axis);
      constexpr HYPRE_BigInt none = std::numeric_limits<HYPRE_BigInt>::max();
      HYPRE_BigInt leader = along.Size() > 0 ? first + along.Min() : none;
      MPI_Allreduce(MPI_IN_PLACE, &leader, 1, HYPRE_MPI_BIG_INT, MPI_MIN, comm);
      if (leader == none)
      {
         throw Error("\"" + surface.name +
                     "\", which a force should move, has no faces");
      }
      Drive drive{surface.name, surface.curve};
      if (leader >= first && leader < first + size)
      {
         drive.leader = static_cast<int>(leader - first);
         drive.share = surface.direction[axis];
      }
      drives.push_back(drive);
      int conflicts = 0;
      for (int d = 0; d < 3; d++)
      {
         if (surface.direction[d] == 0.0)
         {
            continue;
         }
         for (const int dof : DrivenDofs(space, surface, d))
         {
            conflicts += prescribed.FindSorted(dof) >= 0 || driven[dof];
            driven[dof] = true;
            map.push_back({first + dof, leader, surface.direction[d]});
            if (dof != drive.leader)
            {
               idle.Append(dof);
            }
         }
      }
      if (AnyRank(conflicts > 0, comm))
      {
         throw Error("\"" + surface.name +
                     "\", which a force moves, shares points with a surface "
                     "whose displacement along that force is prescribed, or "
                     "which another force moves; leave that displacement free");
      }
   }
   idle.Sort();
   for (int i = 0; i < size; i++)
   {
      if (!driven[i])
      {
         map.push_back({first + i, first + i, 1.0});
      }
   }
   std::vector<Triplet> identity;
   for (const int dof : idle)
   {
      identity.push_back({first + dof, first + dof, 1.0});
   }
   distribution = Square(space, map);
   idle_identity = Square(space, identity);
}

VolumeMatrices RigidSurfaces::Reduce(const VolumeMatrices &matrices) const
{
   VolumeMatrices reduced(matrices);
   const std::unique_ptr<HypreParMatrix> stiffness =
      ReduceBoth(*matrices.stiffness);
   reduced.stiffness.reset(Add(1.0, *stiffness, 1.0, *idle_identity));
   reduced.divergence = Reduce(*matrices.divergence);
   if (matrices.symmetric)
   {
      reduced.divergence_transpose.reset(reduced.divergence->Transpose());
   }
   else
   {
      const std::unique_ptr<HypreParMatrix> other(
         matrices.divergence_transpose->Transpose());
      reduced.divergence_transpose.reset(Reduce(*other)->Transpose());
   }
   return reduced;
}

std::unique_ptr<HypreParMatrix>
RigidSurfaces::Reduce(const HypreParMatrix &matrix) const
{
   return std::unique_ptr<HypreParMatrix>(
      ParMult(&matrix, distribution.get(), true));
}

std::unique_ptr<HypreParMatrix>
RigidSurfaces::ReduceBoth(const HypreParMatrix &matrix) const
{
   return std::unique_ptr<HypreParMatrix>(RAP(&matrix, distribution.get()));
}

void RigidSurfaces::Distribute(Vector &w) const
{
   if (Any())
   {
      const Vector reduced(w);
      distribution->Mult(reduced, w);
      w.HostReadWrite();
   }
}

void RigidSurfaces::Collect(Vector &f) const
{
   if (Any())
   {
      const Vector whole(f);
      distribution->MultTranspose(whole, f);
      f.HostReadWrite();
   }
}

void RigidSurfaces::AddForces(real_t t, Vector &force) const
{
   for (const Drive &drive : drives)
   {
      if (drive.leader >= 0)
      {
         force[drive.leader] += drive.curve(t);
      }
   }
}

std::vector<RigidSurfaces::Travel>
RigidSurfaces::GetTravel(const Vector &u) const
{
   std::vector<Travel> travel;
   for (const Drive &drive : drives)
   {
      const real_t here =
         drive.leader >= 0 ? u[drive.leader] / drive.share : 0.0;
      travel.push_back({drive.name, SumOverRanks(here, comm)});
   }
   return travel;
}

} // namespace synovia
