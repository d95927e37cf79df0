#include "synovia/fem/rigid_motions.hpp"
#include "synovia/fem/node_positions.hpp"
#include "synovia/general/reduce_lists.hpp"
#include "synovia/general/text.hpp"
#include "synovia/mesh/boundary_marker.hpp"

#include <algorithm>
#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
// Part of a motion below which it is round-off.
constexpr real_t tiny = 1e-5;

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

std::string AxisText(const Point3 &direction)
{
   const char *const axes[3] = {"x", "y", "z"};
   const real_t length = Length(direction);
   for (int d = 0; d < 3; d++)
   {
      if (std::abs(direction[d]) > (1.0 - tiny) * length)
      {
         return axes[d];
      }
   }
   return "(" + ToText(direction[0] / length) + ", " +
          ToText(direction[1] / length) + ", " + ToText(direction[2] / length) +
          ")";
}

// Round-off left of zero reads badly.
std::string PlaceText(const Point3 &place, real_t size)
{
   std::string text;
   for (const real_t x : place)
   {
      text += (text.empty() ? "(" : ", ") +
              ToText(std::abs(x) < tiny * size ? 0.0 : x);
   }
   return text + ")";
}
} // namespace

RigidMotions::RigidMotions(const std::vector<Body> &bodies,
                           BiphasicSpaces &spaces)
   : RigidMotions(bodies, spaces, Array<int>())
{
}

RigidMotions::RigidMotions(const std::vector<Body> &bodies,
                           BiphasicSpaces &spaces, const Array<int> &boundary)
   : positions(NodePositions(spaces.Displacement())),
     body_of(BodiesOfDofs(bodies, spaces.Displacement())),
     centers(bodies.size()), radii(bodies.size(), 0.0)
{
   Marker counts(body_of.Size());
   counts = true;
   Center(counts, spaces.GetComm());
   if (boundary.Size() > 0)
   {
      Array<int> dofs;
      spaces.Displacement().GetEssentialTrueDofs(
         BoundaryMarker(spaces.GetMesh(), boundary), dofs);
      counts = false;
      for (const int dof : dofs)
      {
         counts[dof] = true;
      }
      Center(counts, spaces.GetComm());
   }
}

void RigidMotions::Center(const Marker &counts, MPI_Comm comm)
{
   std::vector<real_t> sums(4 * centers.size(), 0.0);
   for (int dof = 0; dof < body_of.Size(); dof += 3)
   {
      if (counts[dof])
      {
         real_t *const sum = &sums[4 * body_of[dof]];
         const Point3 x = PositionOf(positions, dof);
         for (int d = 0; d < 3; d++)
         {
            sum[d] += x[d];
         }
         sum[3] += 1.0;
      }
   }
   SumOverRanks(sums, comm);
   std::vector<real_t> farthest(centers.size(), 0.0);
   for (int b = 0; b < Bodies(); b++)
   {
      for (int d = 0; d < 3 && sums[4 * b + 3] > 0.0; d++)
      {
         centers[b][d] = sums[4 * b + d] / sums[4 * b + 3];
      }
   }
   for (int dof = 0; dof < body_of.Size(); dof += 3)
   {
      if (counts[dof])
      {
         const int b = body_of[dof];
         const Point3 arm = Sum(PositionOf(positions, dof), -1.0, centers[b]);
         farthest[b] = std::max(farthest[b], Length(arm));
      }
   }
   MaxOverRanks(farthest, comm);
   for (int b = 0; b < Bodies(); b++)
   {
      radii[b] = farthest[b] > 0.0 ? farthest[b] : radii[b];
   }
}

real_t RigidMotions::At(int dof, int motion) const
{
   return At(body_of[dof], motion, PositionOf(positions, dof))[dof % 3];
}

Point3 RigidMotions::At(int body, int motion, const Point3 &point) const
{
   Point3 axis{{0.0, 0.0, 0.0}};
   if (motion < 3)
   {
      axis[motion] = 1.0;
      return axis;
   }
   axis[motion - 3] = 1.0 / radii[body];
   return Cross(axis, Sum(point, -1.0, centers[body]));
}

RigidDirection RigidMotions::Direction(int body, const real_t *factors) const
{
   const Point3 shift{factors[0], factors[1], factors[2]};
   const Point3 turn{factors[3], factors[4], factors[5]};
   if (Length(turn) <= tiny)
   {
      return {false, "along " + AxisText(shift)};
   }
   const Point3 rate = Sum({0.0, 0.0, 0.0}, 1.0 / radii[body], turn);
   const Point3 fixed =
      Sum(centers[body], 1.0 / Dot(rate, rate), Cross(rate, shift));
   return {true, "about " + AxisText(turn) + " through " +
                    PlaceText(fixed, radii[body])};
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
