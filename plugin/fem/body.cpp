#include "synovia/fem/body.hpp"

#include <algorithm>
#include <limits>

namespace synovia
{

using namespace mfem;

namespace
{
// The least attribute of the body that each attribute belongs to. A label
// spreads from the elements to their vertices and back until nothing changes.
std::vector<int> LabelBodies(const ParMesh &mesh, ParFiniteElementSpace &space)
{
   std::vector<int> label(mesh.attributes.Max() + 1);
   for (size_t i = 0; i < label.size(); i++)
   {
      label[i] = static_cast<int>(i);
   }
   Array<int> dofs;
   std::vector<int> before;
   while (label != before)
   {
      before = label;
      Array<int> least(space.GetVSize());
      least = std::numeric_limits<int>::max();
      for (int i = 0; i < mesh.GetNE(); i++)
      {
         space.GetElementDofs(i, dofs);
         for (const int dof : dofs)
         {
            least[dof] = std::min(least[dof], label[mesh.GetAttribute(i)]);
         }
      }
      space.GroupComm().Reduce<int>(least, GroupCommunicator::Min);
      space.GroupComm().Bcast(least);
      for (int i = 0; i < mesh.GetNE(); i++)
      {
         int &mine = label[mesh.GetAttribute(i)];
         space.GetElementDofs(i, dofs);
         for (const int dof : dofs)
         {
            mine = std::min(mine, least[dof]);
         }
      }
      MPI_Allreduce(MPI_IN_PLACE, label.data(), static_cast<int>(label.size()),
                    MPI_INT, MPI_MIN, mesh.GetComm());
   }
   return label;
}
} // namespace

bool Body::Touches(const Array<int> &attributes) const
{
   return std::any_of(attributes.begin(), attributes.end(),
                      [&](int attribute)
                      { return boundary.count(attribute) > 0; });
}

std::vector<Body> FindBodies(const NamedMesh &named, BiphasicSpaces &spaces)
{
   const ParMesh &mesh = named.Get();
   const std::vector<int> label = LabelBodies(mesh, spaces.Multiplier());
   std::vector<Body> bodies;
   std::vector<int> body_of(label.size(), -1);
   for (const int attribute : mesh.attributes)
   {
      if (label[attribute] == attribute)
      {
         body_of[attribute] = static_cast<int>(bodies.size());
         bodies.emplace_back();
      }
      body_of[attribute] = body_of[label[attribute]];
      Body &body = bodies[body_of[attribute]];
      body.regions.insert(attribute);
      body.name += (body.name.empty() ? "" : " and ") +
                   NameOf(named.Regions(), attribute);
   }
   const int count = static_cast<int>(bodies.size());
   const int surfaces =
      mesh.bdr_attributes.IsEmpty() ? 0 : mesh.bdr_attributes.Max();
   std::vector<int> on_body(count * (surfaces + 1), 0);
   for (int i = 0; i < mesh.GetNBE(); i++)
   {
      int element;
      int info;
      mesh.GetBdrElementAdjacentElement(i, element, info);
      on_body[mesh.GetBdrAttribute(i) * count +
              body_of[mesh.GetAttribute(element)]] = 1;
   }
   MPI_Allreduce(MPI_IN_PLACE, on_body.data(), static_cast<int>(on_body.size()),
                 MPI_INT, MPI_MAX, mesh.GetComm());
   for (int surface = 1; surface <= surfaces; surface++)
   {
      for (int b = 0; b < count; b++)
      {
         if (on_body[surface * count + b])
         {
            bodies[b].boundary.insert(surface);
         }
      }
   }
   return bodies;
}

std::vector<Body> JoinBodies(const std::vector<Body> &bodies,
                             const std::vector<Array<int>> &joined)
{
   std::vector<Body> all(bodies);
   for (const Array<int> &attributes : joined)
   {
      std::vector<Body> others;
      int first = -1;
      for (const Body &body : all)
      {
         if (first >= 0 && body.Touches(attributes))
         {
            Body &whole = others[first];
            whole.name += " and " + body.name;
            whole.regions.insert(body.regions.begin(), body.regions.end());
            whole.boundary.insert(body.boundary.begin(), body.boundary.end());
            continue;
         }
         if (body.Touches(attributes))
         {
            first = static_cast<int>(others.size());
         }
         others.push_back(body);
      }
      all = others;
   }
   return all;
}

} // namespace synovia
