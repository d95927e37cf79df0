#include "synovia/fem/rigid_ties.hpp"
#include "synovia/fem/rotation_vector.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/reduce.hpp"

#include <algorithm>
#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
// Whether the displacement along an axis is the same whatever the free freedoms
// are: rotations about that axis alone don't change it.
bool Determines(const RigidBodyOptions &body, int axis)
{
   bool all = !body.IsFree(axis);
   bool no_others = all && !body.relative_since;
   for (int d = 0; d < 3; d++)
   {
      all = all && !body.IsFree(d + 3);
      const std::optional<LoadCurve> &rotation = body.prescribed[d + 3];
      no_others = no_others && (d == axis || (rotation && rotation->IsZero()));
   }
   return all || no_others;
}
} // namespace

RigidTies::RigidTies(BiphasicSpaces &spaces,
                     const std::vector<RigidBody> &bodies_,
                     const Array<int> &prescribed, Deformation deformation_,
                     const std::vector<Joint> &joints_)
   : deformation(deformation_), comm(spaces.GetComm()), bodies(bodies_)
{
   std::vector<bool> tied(spaces.Displacement().GetTrueVSize(), false);
   for (int b = 0; b < Bodies(); b++)
   {
      nodes.emplace_back(spaces, bodies[b]);
      bool held = false;
      bool twice = false;
      for (const TiedNodes::Node &node : nodes[b].Get())
      {
         for (int dof = node.dof; dof < node.dof + 3; dof++)
         {
            held = held || (prescribed.FindSorted(dof) >= 0 &&
                            !Determines(bodies[b].options, dof - node.dof));
            twice = twice || tied[dof];
            tied[dof] = true;
            dofs.Append(dof);
         }
      }
      if (AnyRank(held, comm))
      {
         throw Error("the rigid body \"" + bodies[b].name +
                     "\" is tied to points whose displacement is prescribed, "
                     "but is free to move them; leave that displacement free, "
                     "or prescribe the body's");
      }
      if (AnyRank(twice, comm))
      {
         throw Error("the rigid body \"" + bodies[b].name +
                     "\" is tied to points that another one is tied to; the "
                     "surfaces of two rigid bodies must not meet");
      }
      AddSlots(b);
   }
   for (const Joint &joint : joints_)
   {
      AddDrives(joint);
   }
   dofs.Sort();
   origins = Rest();
}

int RigidTies::TakePlace(int body)
{
   // The nodes of all ranks in a row, of which the first have the slots.
   const int here = 3 * static_cast<int>(nodes[body].Get().size());
   int before = 0;
   MPI_Exscan(&here, &before, 1, MPI_INT, MPI_SUM, comm);
   int rank = 0;
   MPI_Comm_rank(comm, &rank);
   before = rank == 0 ? 0 : before;
   const int mine = taken[body] - before;
   taken[body]++;
   return mine >= 0 && mine < here ? nodes[body].Get()[mine / 3].dof + mine % 3
                                   : -1;
}

void RigidTies::AddSlots(int body)
{
   taken.push_back(0);
   for (int freedom = 0; freedom < 6; freedom++)
   {
      if (bodies[body].options.IsFree(freedom))
      {
         slots.push_back({body, freedom, TakePlace(body),
                          freedom < 3 ? 1.0 : 1.0 / nodes[body].Radius()});
      }
   }
}

void RigidTies::AddDrives(const Joint &joint)
{
   const int number = joints;
   joints++;
   radii.push_back(0.0);
   for (int coordinate = 0; coordinate < 6; coordinate++)
   {
      if (!joint.prescribed[coordinate])
      {
         continue;
      }
      int dof = -1;
      for (const std::string &name : {joint.distal.body, joint.proximal.body})
      {
         const int body = Find(name);
         if (body >= 0 && !AnyRank(dof >= 0, comm))
         {
            dof = TakePlace(body);
            radii[number] = nodes[body].Radius();
         }
      }
      if (!AnyRank(dof >= 0, comm))
      {
         throw Error("the joint \"" + joint.name +
                     "\" prescribes more coordinates than there is place for "
                     "at the nodes that are tied to its bodies; tie more faces "
                     "to them, or prescribe freedoms of a body");
      }
      slots.push_back({DriveOf(number), coordinate, dof, 1.0});
   }
}

void RigidTies::ScaleDrives(real_t stiffness)
{
   for (Slot &slot : slots)
   {
      if (!IsFreedom(slot))
      {
         slot.scale = slot.freedom < 3 ? stiffness * radii[slot.body - Bodies()]
                                       : stiffness;
      }
   }
}

int RigidTies::Find(const std::string &name) const
{
   const auto found =
      std::find_if(bodies.begin(), bodies.end(),
                   [&](const RigidBody &body) { return body.name == name; });
   return found == bodies.end() ? -1 : static_cast<int>(found - bodies.begin());
}

RigidPoses RigidTies::Rest() const
{
   return RigidPoses(bodies.size() + joints,
                     RigidPose{{0.0, 0.0, 0.0, 0.0, 0.0, 0.0}});
}

void RigidTies::SetOrigins(real_t t, const RigidPoses &poses)
{
   for (int b = 0; b < Bodies(); b++)
   {
      if (Options(b).relative_since == t)
      {
         origins[b] = poses[b];
      }
   }
}

void RigidTies::Archive(StateArchive &archive)
{
   for (int b = 0; b < Bodies(); b++)
   {
      for (int i = 0; i < 6 && Options(b).relative_since; i++)
      {
         archive.Number("rigid_body." + Name(b) + ".origin." +
                           std::to_string(i),
                        origins[b][i]);
      }
   }
}

void RigidTies::Prescribe(real_t t, RigidPoses &poses) const
{
   for (int b = 0; b < Bodies(); b++)
   {
      for (int i = 0; i < 6; i++)
      {
         if (!Options(b).IsFree(i))
         {
            poses[b][i] = (*Options(b).prescribed[i])(t);
            if (Options(b).relative_since)
            {
               poses[b][i] += origins[b][i];
            }
         }
      }
   }
}

bool RigidTies::OnlyTurns(int body) const
{
   bool only = IsFinite();
   for (int i = 3; i < 6; i++)
   {
      only =
         only && Options(body).IsFree(i) && Options(body).stiffness[i] == 0.0;
   }
   return only;
}

void RigidTies::Shorten(RigidPoses &poses) const
{
   for (int b = 0; b < Bodies(); b++)
   {
      if (OnlyTurns(b))
      {
         const Point3 rotation = Shortened(RotationOf(poses[b]));
         std::copy(rotation.begin(), rotation.end(), poses[b].begin() + 3);
      }
   }
}

real_t RigidTies::Approach(int body, const Vector &u, RigidPose &pose) const
{
   const TiedNodes &tied = nodes[body];
   const RigidFrame frame(pose, deformation);
   Vector sums(6 + 36);
   sums = 0.0;
   DenseMatrix normal(sums.GetData() + 6, 6, 6);
   for (const TiedNodes::Node &node : tied.Get())
   {
      const Point3 now{{u[node.dof], u[node.dof + 1], u[node.dof + 2]}};
      const Point3 missing = Sum(now, -1.0, frame.Displacement(node.arm));
      const Point3 arm = frame.Turned(node.arm);
      Point3 motions[6];
      for (int i = 0; i < 6; i++)
      {
         Point3 unit{{0.0, 0.0, 0.0}};
         unit[i % 3] = i < 3 ? 1.0 : 1.0 / tied.Radius();
         motions[i] = i < 3 ? unit : Cross(Times(frame.Spin(), unit), arm);
      }
      for (int j = 0; j < 6; j++)
      {
         sums[j] += Dot(motions[j], missing);
         for (int i = 0; i < 6; i++)
         {
            normal(i, j) += Dot(motions[i], motions[j]);
         }
      }
   }
   MPI_Allreduce(MPI_IN_PLACE, sums.GetData(), sums.Size(),
                 MPITypeMap<real_t>::mpi_type, MPI_SUM, comm);
   const DenseMatrixInverse inverse(normal);
   Vector amounts(6);
   inverse.Mult(Vector(sums.GetData(), 6), amounts);
   for (int i = 0; i < 6; i++)
   {
      pose[i] += i < 3 ? amounts[i] : amounts[i] / tied.Radius();
   }
   return amounts.Normlinf();
}

RigidPoses RigidTies::Fit(const Vector &u, const RigidPoses &guess) const
{
   constexpr int most_steps = 50;
   // Relative to the radius; displacements that no pose gives are a guess only.
   constexpr real_t close = 1e-12;
   RigidPoses poses(guess);
   u.HostRead();
   for (int b = 0; b < Bodies(); b++)
   {
      real_t change = nodes[b].Radius();
      for (int step = 0;
           step < most_steps && change > close * nodes[b].Radius(); step++)
      {
         change = Approach(b, u, poses[b]);
      }
   }
   Shorten(poses);
   return poses;
}

void RigidTies::Write(const RigidPoses &poses, Vector &u) const
{
   u.HostReadWrite();
   for (int b = 0; b < Bodies(); b++)
   {
      const RigidFrame frame = Frame(b, poses);
      for (const TiedNodes::Node &node : nodes[b].Get())
      {
         const Point3 displacement = frame.Displacement(node.arm);
         std::copy(displacement.begin(), displacement.end(),
                   u.GetData() + node.dof);
      }
   }
}

RigidPoses RigidTies::Moved(const RigidPoses &poses, real_t share,
                            const Vector &step) const
{
   RigidPoses moved(poses);
   const Vector amounts = Gather(step);
   for (int k = 0; k < amounts.Size(); k++)
   {
      const Slot &slot = slots[k];
      moved[slot.body][slot.freedom] += share * slot.scale * amounts[k];
   }
   return moved;
}

Vector RigidTies::Gather(const Vector &w) const
{
   w.HostRead();
   Vector amounts(static_cast<int>(slots.size()));
   for (int k = 0; k < amounts.Size(); k++)
   {
      amounts[k] = slots[k].dof >= 0 ? w[slots[k].dof] : 0.0;
   }
   MPI_Allreduce(MPI_IN_PLACE, amounts.GetData(), amounts.Size(),
                 MPITypeMap<real_t>::mpi_type, MPI_SUM, comm);
   return amounts;
}

void RigidTies::Scatter(const Vector &amounts, Vector &w) const
{
   w.HostReadWrite();
   for (int k = 0; k < amounts.Size(); k++)
   {
      if (slots[k].dof >= 0)
      {
         w[slots[k].dof] = amounts[k];
      }
   }
}

} // namespace synovia
