#include "synovia/fem/tied_nodes.hpp"
#include "synovia/fem/node_positions.hpp"
#include "synovia/fem/null_space.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/mesh/boundary_marker.hpp"
#include "synovia/mesh/surface_center.hpp"

#include <algorithm>
#include <limits>

namespace synovia
{

using namespace mfem;

namespace
{
// True dofs of the x component, ascending.
Array<int> FindDofs(BiphasicSpaces &spaces, const RigidBody &body)
{
   ParFiniteElementSpace &space = spaces.Displacement();
   const Array<int> marker = BoundaryMarker(spaces.GetMesh(), body.boundary);
   Array<int> tied;
   space.GetEssentialVDofs(marker, tied, 0);
   Array<int> dofs;
   for (int e = 0; e < space.GetNE(); e++)
   {
      if (body.regions.Find(spaces.GetMesh().GetAttribute(e)) >= 0)
      {
         space.GetElementDofs(e, dofs);
         for (const int dof : dofs)
         {
            tied[space.DofToVDof(dof, 0)] = -1;
         }
      }
   }
   space.Synchronize(tied);
   Array<int> true_dofs;
   for (int dof = 0; dof < tied.Size(); dof++)
   {
      const int true_dof = space.GetLocalTDofNumber(dof);
      if (tied[dof] && true_dof >= 0)
      {
         true_dofs.Append(true_dof);
      }
   }
   true_dofs.Sort();
   return true_dofs;
}
} // namespace

TiedNodes::TiedNodes(BiphasicSpaces &spaces, const RigidBody &body)
{
   MPI_Comm comm = spaces.GetComm();
   const Array<int> dofs = FindDofs(spaces, body);
   if (!AnyRank(dofs.Size() > 0, comm))
   {
      throw Error("the surfaces that the rigid body \"" + body.name +
                  "\" is tied to have no faces");
   }
   reference = body.options.reference
                  ? *body.options.reference
                  : CenterOfArea(spaces.GetMesh(), body.boundary);
   const Vector positions = NodePositions(spaces.Displacement());
   for (const int dof : dofs)
   {
      const Point3 place{
         {positions[dof], positions[dof + 1], positions[dof + 2]}};
      nodes.push_back({dof, Sum(place, -1.0, reference)});
      radius = std::max(radius, Length(nodes.back().arm));
   }
   // A single node would be at its own distance from itself.
   radius =
      std::max(MaxOverRanks(radius, comm), std::numeric_limits<real_t>::min());
   squares.SetSize(6);
   squares = 0.0;
   real_t count = 0.0;
   for (const Node &node : nodes)
   {
      for (int j = 0; j < 6; j++)
      {
         for (int i = 0; i < 6; i++)
         {
            squares(i, j) += Dot(Motion(i, node.arm), Motion(j, node.arm));
         }
      }
      count += 1.0;
   }
   MPI_Allreduce(MPI_IN_PLACE, squares.Data(), 36, MPITypeMap<real_t>::mpi_type,
                 MPI_SUM, comm);
   DenseMatrix mean(squares);
   mean *= 1.0 / SumOverRanks(count, comm);
   if (!NullSpace(mean).empty())
   {
      throw Error("the nodes that are tied to the rigid body \"" + body.name +
                  "\" lie on a line, so that its rotation is not known; tie "
                  "more surfaces to it");
   }
}

Point3 TiedNodes::Motion(int freedom, const Point3 &arm) const
{
   Point3 unit{{0.0, 0.0, 0.0}};
   unit[freedom % 3] = freedom < 3 ? 1.0 : 1.0 / radius;
   return freedom < 3 ? unit : Cross(unit, arm);
}

} // namespace synovia
