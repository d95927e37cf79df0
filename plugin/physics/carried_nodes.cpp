#include "synovia/physics/carried_nodes.hpp"
#include "synovia/fem/node_positions.hpp"
#include "synovia/fem/rigid_motions.hpp"
#include "synovia/fem/rotation_vector.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

namespace
{
constexpr int nobody = -1;

int CarrierOf(const Body &body, const std::vector<RigidBody> &rigid_bodies)
{
   int carrier = nobody;
   for (std::size_t b = 0; b < rigid_bodies.size(); b++)
   {
      if (!body.Touches(rigid_bodies[b].boundary))
      {
         continue;
      }
      if (carrier != nobody)
      {
         return nobody;
      }
      carrier = static_cast<int>(b);
   }
   return carrier;
}

/// R of a pose's rotation vector.
DenseMatrix TurnOf(const RigidPose &pose)
{
   return RotationMatrix(RotationOf(pose));
}
} // namespace

CarriedNodes::CarriedNodes(const std::vector<Body> &bodies,
                           BiphasicSpaces &spaces,
                           const std::vector<RigidBody> &rigid_bodies,
                           const RigidTies &ties_)
   : ties(ties_), carries(rigid_bodies.size(), false)
{
   if (!ties.Any() || !ties.IsFinite())
   {
      return;
   }
   std::vector<int> carriers;
   for (const Body &body : bodies)
   {
      carriers.push_back(CarrierOf(body, rigid_bodies));
      if (carriers.back() != nobody)
      {
         carries[carriers.back()] = true;
         any = true;
      }
   }
   const RigidMotions motions(bodies, spaces);
   const Vector positions = NodePositions(spaces.Displacement());
   for (int dof = 0; dof < positions.Size(); dof += 3)
   {
      const int carrier = carriers[motions.BodyOf(dof)];
      if (carrier != nobody && ties.Dofs().FindSorted(dof) < 0)
      {
         const Point3 position{
            {positions[dof], positions[dof + 1], positions[dof + 2]}};
         nodes.push_back(
            {dof, carrier,
             Sum(position, -1.0, ties.Nodes(carrier).Reference())});
      }
   }
}

void CarriedNodes::Carry(const RigidPoses &from, const RigidPoses &to,
                         Vector &u) const
{
   std::vector<DenseMatrix> before;
   std::vector<DenseMatrix> after;
   for (int b = 0; b < ties.Bodies(); b++)
   {
      before.push_back(TurnOf(from[b]));
      after.push_back(TurnOf(to[b]));
   }
   u.HostReadWrite();
   for (const Node &node : nodes)
   {
      const int b = node.carrier;
      const Point3 now{{u[node.dof], u[node.dof + 1], u[node.dof + 2]}};
      const Point3 arm = TransposeTimes(
         before[b], Sum(Sum(node.arm, 1.0, now), -1.0, TranslationOf(from[b])));
      const Point3 place = Sum(TranslationOf(to[b]), 1.0, Times(after[b], arm));
      const Point3 displacement = Sum(place, -1.0, node.arm);
      std::copy(displacement.begin(), displacement.end(),
                u.GetData() + node.dof);
   }
}

void CarriedNodes::Copy(const Vector &other, Vector &u) const
{
   other.HostRead();
   u.HostReadWrite();
   for (const Node &node : nodes)
   {
      std::copy_n(other.GetData() + node.dof, 3, u.GetData() + node.dof);
   }
}

real_t CarriedNodes::Turn(const RigidPoses &from, const RigidPoses &to) const
{
   real_t largest = 0.0;
   for (int b = 0; b < ties.Bodies(); b++)
   {
      if (carries[b])
      {
         DenseMatrix between(3);
         MultABt(TurnOf(to[b]), TurnOf(from[b]), between);
         const real_t cosine = 0.5 * (between.Trace() - 1.0);
         largest =
            std::max(largest, std::acos(std::clamp<real_t>(cosine, -1.0, 1.0)));
      }
   }
   return largest;
}

} // namespace synovia
