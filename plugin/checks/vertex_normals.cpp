#include "synovia/checks/vertex_normals.hpp"
#include "synovia/general/angle_between.hpp"

#include <algorithm>
#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
// Faces that are turned from the mean normal by more than 30 degrees meet at an
// edge.
constexpr real_t smooth_cosine = 0.866;
// Around a vertex within a surface the angles add up to 2 pi, at its rim to
// about half of that.
constexpr real_t angle_within = 1.5 * M_PI;

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

real_t AngleAt(const std::vector<Point3> &points, size_t corner)
{
   const size_t count = points.size();
   const Point3 &at = points[corner];
   const Point3 next = Sum(points[(corner + 1) % count], -1.0, at);
   const Point3 last = Sum(points[(corner + count - 1) % count], -1.0, at);
   return AngleBetween(next, last);
}
} // namespace

Point3 FaceCorners::Center() const
{
   Point3 center{{0.0, 0.0, 0.0}};
   for (const Point3 &point : points)
   {
      center = Sum(center, 1.0 / points.size(), point);
   }
   return center;
}

Point3 FaceCorners::AreaVector() const
{
   return AreaOf(points);
}

Point3 FaceCorners::Normal(size_t corner) const
{
   const Point3 own = Unit(AreaVector());
   return Dot(own, normals[corner]) > smooth_cosine ? normals[corner] : own;
}

VertexNormals::VertexNormals(BiphasicSpaces &spaces_,
                             const Array<int> &surfaces)
   : spaces(spaces_), normals(spaces.Multiplier().GetVSize()),
     least_cosine(spaces.Multiplier().GetVSize()),
     angle(spaces.Multiplier().GetVSize())
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
   angle = 0.0;
   const auto for_each_face = [&](auto visit)
   {
      Array<int> dofs;
      for (int i = 0; i < mesh.GetNBE(); i++)
      {
         if (surfaces.Find(mesh.GetBdrAttribute(i)) >= 0)
         {
            vertices.GetBdrElementDofs(i, dofs);
            visit(dofs, PointsOf(mesh, i));
         }
      }
   };
   for_each_face(
      [&](const Array<int> &dofs, const std::vector<Point3> &points)
      {
         const Point3 area = AreaOf(points);
         for (int k = 0; k < dofs.Size(); k++)
         {
            angle[dofs[k]] += AngleAt(points, k);
            for (int d = 0; d < 3; d++)
            {
               sums[d][dofs[k]] += area[d];
            }
         }
      });
   for (Array<real_t> *sum : {&sums[0], &sums[1], &sums[2], &angle})
   {
      vertices.GroupComm().Reduce<real_t>(*sum, GroupCommunicator::Sum);
      vertices.GroupComm().Bcast(*sum);
   }
   for (int i = 0; i < count; i++)
   {
      normals[i] = Unit({sums[0][i], sums[1][i], sums[2][i]});
   }
   least_cosine = 1.0;
   for_each_face(
      [&](const Array<int> &dofs, const std::vector<Point3> &points)
      {
         const Point3 normal = Unit(AreaOf(points));
         for (const int dof : dofs)
         {
            least_cosine[dof] =
               std::min(least_cosine[dof], Dot(normals[dof], normal));
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
      face.smooth.push_back(least_cosine[dof] > smooth_cosine &&
                            angle[dof] > angle_within);
   }
   return face;
}

} // namespace synovia
