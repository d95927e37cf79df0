#include "synovia/fem/joints.hpp"
#include "synovia/fem/null_space.hpp"
#include "synovia/general/error.hpp"

#include <algorithm>
#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
/// Prescribed coordinates, each by how free freedoms change it.
class Drives
{
public:
   void Add(const std::string &name, const Vector &row)
   {
      names.push_back(name);
      rows.push_back(row);
      const real_t size = row.Norml2();
      if (size > 0.0)
      {
         rows.back() /= size;
      }
   }

   // Throws Error if one follows from others and from what is not free.
   void VerifyIndependent() const
   {
      // Part of a coordinate that counts.
      constexpr real_t tiny = 1e-6;
      DenseMatrix products(static_cast<int>(rows.size()));
      for (int j = 0; j < products.Width(); j++)
      {
         for (int i = 0; i < products.Height(); i++)
         {
            products(i, j) = rows[i] * rows[j];
         }
      }
      const std::vector<Vector> dependent =
         rows.empty() ? std::vector<Vector>() : NullSpace(products);
      if (dependent.empty())
      {
         return;
      }
      std::string text;
      for (int i = 0; i < products.Height(); i++)
      {
         if (std::abs(dependent.front()[i]) > tiny)
         {
            text += (text.empty() ? "" : " and ") + names[i];
         }
      }
      throw Error(text +
                  " can't be prescribed, as nothing that is free changes it by "
                  "itself; leave it free, or more freedoms of the bodies");
   }

private:
   std::vector<std::string> names;
   std::vector<Vector> rows;
};
} // namespace

Joints::Joints(const RigidTies &ties_, const std::vector<Joint> &joints_)
   : ties(ties_), joints(joints_)
{
   for (const Joint &joint : joints)
   {
      bodies.push_back(
         {ties.Find(joint.proximal.body), ties.Find(joint.distal.body)});
   }
   Drives drives;
   const RigidPoses rest = ties.Rest();
   for (std::size_t j = 0; j < joints.size(); j++)
   {
      const int joint = static_cast<int>(j);
      const Coordinates coordinates = CoordinatesOf(joint, rest);
      for (int k = 0; k < 6; k++)
      {
         if (!IsPrescribed(joint, k))
         {
            continue;
         }
         Vector row(static_cast<int>(ties.Slots().size()));
         for (int s = 0; s < row.Size(); s++)
         {
            const RigidTies::Slot &slot = ties.Slots()[s];
            const int variable = VariableOf(joint, slot);
            row[s] = variable >= 0 ? slot.scale * coordinates[k].first[variable]
                                   : 0.0;
         }
         drives.Add(JointCoordinateNames()[k] + " of the joint \"" +
                       joints[j].name + "\"",
                    row);
      }
   }
   drives.VerifyIndependent();
}

Joints::Coordinates Joints::CoordinatesOf(int joint,
                                          const RigidPoses &poses) const
{
   std::array<BonePose, 2> bones;
   for (int side = 0; side < 2; side++)
   {
      const int body = bodies[joint][side];
      if (body >= 0)
      {
         bones[side] = {poses[body], ties.Nodes(body).Reference()};
      }
   }
   return JointCoordinates(joints[joint], bones[0], bones[1],
                           ties.IsFinite() ? Deformation::finite
                                           : Deformation::infinitesimal);
}

bool Joints::IsDriven(int joint) const
{
   const auto &prescribed = joints[joint].prescribed;
   return std::any_of(prescribed.begin(), prescribed.end(),
                      [](const auto &curve) { return curve.has_value(); });
}

int Joints::VariableOf(int joint, const RigidTies::Slot &slot) const
{
   for (int side = 0; side < 2; side++)
   {
      if (slot.body == bodies[joint][side])
      {
         return 6 * side + slot.freedom;
      }
   }
   return -1;
}

std::vector<Joints::State> Joints::States(const RigidPoses &poses) const
{
   std::vector<State> states;
   for (std::size_t j = 0; j < joints.size(); j++)
   {
      const int joint = static_cast<int>(j);
      const Coordinates coordinates = CoordinatesOf(joint, poses);
      State state;
      for (int k = 0; k < 6; k++)
      {
         state.coordinates[k] = coordinates[k].value;
         state.drives[k] =
            IsPrescribed(joint, k) ? poses[ties.DriveOf(joint)][k] : 0.0;
      }
      states.push_back(state);
   }
   return states;
}

void Joints::AddForces(const RigidPoses &poses, real_t t, Vector &forces) const
{
   for (std::size_t j = 0; j < joints.size(); j++)
   {
      const int joint = static_cast<int>(j);
      if (!IsDriven(joint))
      {
         continue;
      }
      const Coordinates coordinates = CoordinatesOf(joint, poses);
      const RigidPose &drives = poses[ties.DriveOf(joint)];
      for (int s = 0; s < forces.Size(); s++)
      {
         const RigidTies::Slot &slot = ties.Slots()[s];
         if (slot.body == ties.DriveOf(joint))
         {
            const int k = slot.freedom;
            const real_t beyond =
               coordinates[k].value - (*joints[joint].prescribed[k])(t);
            // Angles are the same after a turn.
            forces[s] += slot.scale *
                         (k < 3 ? std::remainder(beyond, 2.0 * M_PI) : beyond);
            continue;
         }
         const int variable = VariableOf(joint, slot);
         for (int k = 0; variable >= 0 && k < 6; k++)
         {
            if (IsPrescribed(joint, k))
            {
               forces[s] +=
                  slot.scale * drives[k] * coordinates[k].first[variable];
            }
         }
      }
   }
}

void Joints::AddStiffness(const RigidPoses &poses, DenseMatrix &stiffness) const
{
   const std::vector<RigidTies::Slot> &slots = ties.Slots();
   for (std::size_t j = 0; j < joints.size(); j++)
   {
      const int joint = static_cast<int>(j);
      if (!IsDriven(joint))
      {
         continue;
      }
      const Coordinates coordinates = CoordinatesOf(joint, poses);
      const RigidPose &drives = poses[ties.DriveOf(joint)];
      for (int a = 0; a < stiffness.Height(); a++)
      {
         const int of_a = VariableOf(joint, slots[a]);
         for (int b = 0; of_a >= 0 && b < stiffness.Height(); b++)
         {
            const real_t scale = slots[a].scale * slots[b].scale;
            if (slots[b].body == ties.DriveOf(joint))
            {
               const real_t slope = coordinates[slots[b].freedom].first[of_a];
               stiffness(a, b) -= scale * slope;
               stiffness(b, a) -= scale * slope;
               continue;
            }
            const int of_b = VariableOf(joint, slots[b]);
            for (int k = 0; of_b >= 0 && k < 6; k++)
            {
               if (IsPrescribed(joint, k))
               {
                  stiffness(a, b) -=
                     scale * drives[k] * coordinates[k].second[of_a][of_b];
               }
            }
         }
      }
   }
}

} // namespace synovia
