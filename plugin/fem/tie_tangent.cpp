#include "synovia/fem/tie_tangent.hpp"

namespace synovia
{

using namespace mfem;

TieTangent::TieTangent(const RigidTies &ties_, const Ligaments &ligaments_,
                       const Joints &joints_)
   : ties(ties_), ligaments(ligaments_), joints(joints_)
{
   const RigidPoses rest = ties.Rest();
   for (int b = 0; b < ties.Bodies(); b++)
   {
      frames.push_back(ties.Frame(b, rest));
   }
   stiffness.SetSize(static_cast<int>(ties.Slots().size()));
   stiffness = 0.0;
}

void TieTangent::Linearize(const RigidPoses &poses, real_t t,
                           const Vector &forces)
{
   frames.clear();
   for (int b = 0; b < ties.Bodies(); b++)
   {
      frames.push_back(ties.Frame(b, poses));
   }
   std::vector<TiedForces> sums = SumForces(ties, poses, forces);
   ligaments.AddForces(poses, sums);
   stiffness = FreedomStiffness(ties, poses, t, sums);
   ligaments.AddStiffness(poses, stiffness);
   joints.AddStiffness(poses, stiffness);
}

Point3 TieTangent::Motion(const RigidTies::Slot &slot, const Point3 &arm) const
{
   return Sum({{0.0, 0.0, 0.0}}, slot.scale,
              frames[slot.body].Motion(slot.freedom, arm));
}

void TieTangent::Move(const Vector &amounts, Vector &u) const
{
   u.HostReadWrite();
   u.SetSubVector(ties.Dofs(), 0.0);
   for (int k = 0; k < amounts.Size(); k++)
   {
      const RigidTies::Slot &slot = ties.Slots()[k];
      if (!ties.IsFreedom(slot))
      {
         continue;
      }
      for (const TiedNodes::Node &node : ties.Nodes(slot.body).Get())
      {
         const Point3 motion = Motion(slot, node.arm);
         for (int d = 0; d < 3; d++)
         {
            u[node.dof + d] += amounts[k] * motion[d];
         }
      }
   }
}

Vector TieTangent::Collect(const Vector &f) const
{
   f.HostRead();
   Vector sums(static_cast<int>(ties.Slots().size()));
   sums = 0.0;
   for (int k = 0; k < sums.Size(); k++)
   {
      const RigidTies::Slot &slot = ties.Slots()[k];
      if (!ties.IsFreedom(slot))
      {
         continue;
      }
      for (const TiedNodes::Node &node : ties.Nodes(slot.body).Get())
      {
         const Point3 motion = Motion(slot, node.arm);
         for (int d = 0; d < 3; d++)
         {
            sums[k] += motion[d] * f[node.dof + d];
         }
      }
   }
   MPI_Allreduce(MPI_IN_PLACE, sums.GetData(), sums.Size(),
                 MPITypeMap<real_t>::mpi_type, MPI_SUM, ties.GetComm());
   return sums;
}

} // namespace synovia
