#include "checks/vertex_normals.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

namespace
{
// Faces that are turned from the mean normal by more than 30 degrees meet at an
// edge.
constexpr real_t smooth_cosine = 0.866;

// The corners of a boundary element, seen from outside, and its area vector.
std::vector<Point3> PointsOf(ParMesh &mesh, int boundary_element)
{
   DenseMatrix x;
   mesh.GetBdrElementTransformation(boundary_element)
      ->Transform(
         *Geometries.GetVertices(mesh.GetBdrElementGeometry(boundary_element)),
         x);
   std::vector<Point3> points;
   for (int i = 0; i < x.Width(); i++)
   {
      points.push_back({x(0, i), x(1, i), x(2, i)});
   }
   return points;
}

Point3 AreaOf(const std::vector<Point3> &points)
{
   Point3 area{{0.0, 0.0, 0.0}};
   for (size_t i = 2; i < points.size(); i++)
   {
      area = Sum(area, 0.5,
                 Cross(Sum(points[i - 1], -1.0, points[0]),
                       Sum(points[i], -1.0, points[0])));
   }
   return area;
}

Point3 Unit(const Point3 &vector)
{
   const real_t length = Length(vector);
   return Sum({0, 0, 0}, length > 0.0 ? 1.0 / length : 0.0, vector);
}
} // namespace

Point3 FaceCorners::Centre() const
{
   Point3 centre{{0.0, 0.0, 0.0}};
   for (const Point3 &point : points)
   {
      centre = Sum(centre, 1.0 / points.size(), point);
   }
   return centre;
}

VertexNormals::VertexNormals(BiphasicSpaces &spaces_,
                             const Array<int> &surfaces)
   : spaces(spaces_), normals(spaces.Multiplier().GetVSize()),
     least_cosine(spaces.Multiplier().GetVSize())
{
   ParMesh &mesh = spaces.GetMesh();
   ParFiniteElementSpace &vertices = spaces.Multiplier();
   const int count = vertices.GetVSize();
   Array<real_t> sums[3];
   for (Array<real_t> &sum : sums)
   {
      sum.SetSize(count);
      sum = 0.0;
   }
   const auto for_each_face = [&](auto visit)
   {
      Array<int> dofs;
      for (int i = 0; i < mesh.GetNBE(); i++)
      {
         if (surfaces.Find(mesh.GetBdrAttribute(i)) >= 0)
         {
            vertices.GetBdrElementDofs(i, dofs);
            visit(dofs, AreaOf(PointsOf(mesh, i)));
         }
      }
   };
   for_each_face(
      [&](const Array<int> &dofs, const Point3 &area)
      {
         for (const int dof : dofs)
         {
            for (int d = 0; d < 3; d++)
            {
               sums[d][dof] += area[d];
            }
         }
      });
   for (Array<real_t> &sum : sums)
   {
      vertices.GroupComm().Reduce<real_t>(sum, GroupCommunicator::Sum);
      vertices.GroupComm().Bcast(sum);
   }
   for (int i = 0; i < count; i++)
   {
      normals[i] = Unit({sums[0][i], sums[1][i], sums[2][i]});
   }
   least_cosine = 1.0;
   for_each_face(
      [&](const Array<int> &dofs, const Point3 &area)
      {
         for (const int dof : dofs)
         {
            least_cosine[dof] =
               std::min(least_cosine[dof], Dot(normals[dof], Unit(area)));
         }
      });
   vertices.GroupComm().Reduce<real_t>(least_cosine, GroupCommunicator::Min);
   vertices.GroupComm().Bcast(least_cosine);
}

FaceCorners VertexNormals::Corners(int boundary_element) const
{
   FaceCorners face;
   face.points = PointsOf(spaces.GetMesh(), boundary_element);
   Array<int> dofs;
   spaces.Multiplier().GetBdrElementDofs(boundary_element, dofs);
   for (const int dof : dofs)
   {
      face.normals.push_back(normals[dof]);
      face.sharp.push_back(least_cosine[dof] < smooth_cosine);
   }
   return face;
}

} // namespace synovia
