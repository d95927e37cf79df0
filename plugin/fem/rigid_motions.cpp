#include "synovia/fem/rigid_motions.hpp"
#include "synovia/fem/node_positions.hpp"
#include "synovia/general/reduce.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

namespace
{
Array<int> BodiesOfDofs(const std::vector<Body> &bodies,
                        ParFiniteElementSpace &space)
{
   const ParMesh &mesh = *space.GetParMesh();
   Array<int> body_of(space.GetTrueVSize());
   body_of = 0;
   Array<int> dofs;
   for (int i = 0; i < mesh.GetNE(); i++)
   {
      int body = 0;
      while (bodies[body].regions.count(mesh.GetAttribute(i)) == 0)
      {
         body++;
      }
      space.GetElementVDofs(i, dofs);
      for (const int dof : dofs)
      {
         const int mine = space.GetLocalTDofNumber(dof);
         if (mine >= 0)
         {
            body_of[mine] = body;
         }
      }
   }
   return body_of;
}

Point3 PositionOf(const Vector &positions, int dof)
{
   const int x = dof - dof % 3;
   return {positions[x], positions[x + 1], positions[x + 2]};
}
} // namespace

RigidMotions::RigidMotions(const std::vector<Body> &bodies,
                           BiphasicSpaces &spaces)
   : positions(NodePositions(spaces.Displacement())),
     body_of(BodiesOfDofs(bodies, spaces.Displacement())),
     centers(bodies.size()), radii(bodies.size(), 0.0)
{
   MPI_Comm comm = spaces.GetComm();
   std::vector<std::array<real_t, 4>> sums(bodies.size());
   for (int dof = 0; dof < body_of.Size(); dof += 3)
   {
      std::array<real_t, 4> &sum = sums[body_of[dof]];
      const Point3 x = PositionOf(positions, dof);
      for (int d = 0; d < 3; d++)
      {
         sum[d] += x[d];
      }
      sum[3] += 1.0;
   }
   MPI_Allreduce(MPI_IN_PLACE, sums.data(), 4 * Bodies(),
                 MPITypeMap<real_t>::mpi_type, MPI_SUM, comm);
   for (int b = 0; b < Bodies(); b++)
   {
      for (int d = 0; d < 3; d++)
      {
         centers[b][d] = sums[b][d] / sums[b][3];
      }
   }
   for (int dof = 0; dof < body_of.Size(); dof += 3)
   {
      const int b = body_of[dof];
      const Point3 arm = Sum(PositionOf(positions, dof), -1.0, centers[b]);
      radii[b] = std::max(radii[b], Length(arm));
   }
   MPI_Allreduce(MPI_IN_PLACE, radii.data(), Bodies(),
                 MPITypeMap<real_t>::mpi_type, MPI_MAX, comm);
}

real_t RigidMotions::At(int dof, int motion) const
{
   const int component = dof % 3;
   if (motion < 3)
   {
      return component == motion ? 1.0 : 0.0;
   }
   const int b = body_of[dof];
   const Point3 arm = Sum(PositionOf(positions, dof), -1.0, centers[b]);
   Point3 axis{{0.0, 0.0, 0.0}};
   axis[motion - 3] = 1.0 / radii[b];
   return Cross(axis, arm)[component];
}

Vector RigidMotions::OfAll(int motion) const
{
   Vector u(body_of.Size());
   for (int dof = 0; dof < u.Size(); dof++)
   {
      u[dof] = At(dof, motion);
   }
   return u;
}

Vector RigidMotions::Displacement(int body, int motion) const
{
   Vector u(body_of.Size());
   u = 0.0;
   for (int dof = 0; dof < u.Size(); dof++)
   {
      if (body_of[dof] == body)
      {
         u[dof] = At(dof, motion);
      }
   }
   return u;
}

Vector RigidMotions::Translation(const std::set<int> &bodies,
                                 const Point3 &along) const
{
   Vector u(body_of.Size());
   u = 0.0;
   for (int dof = 0; dof < u.Size(); dof++)
   {
      if (bodies.count(body_of[dof]) > 0)
      {
         u[dof] = along[dof % 3];
      }
   }
   return u;
}

} // namespace synovia
