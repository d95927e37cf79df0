#include "synovia/fem/tie_tangent.hpp"
#include "synovia/fem/rotation_vector.hpp"

namespace synovia
{

using namespace mfem;

TieTangent::TieTangent(const RigidTies &ties_) : ties(ties_)
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
   stiffness = FreedomStiffness(ties, poses, t, SumForces(ties, poses, forces));
}

Point3 TieTangent::Motion(const RigidTies::Slot &slot, const Point3 &arm) const
{
   Point3 amount{{0.0, 0.0, 0.0}};
   amount[slot.freedom % 3] = slot.scale;
   if (slot.freedom < 3)
   {
      return amount;
   }
   const RigidFrame &frame = frames[slot.body];
   return Cross(Times(frame.Spin(), amount), frame.Turned(arm));
}

void TieTangent::Move(const Vector &amounts, Vector &u) const
{
   u.HostReadWrite();
   u.SetSubVector(ties.Dofs(), 0.0);
   for (int k = 0; k < amounts.Size(); k++)
   {
      const RigidTies::Slot &slot = ties.Slots()[k];
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
