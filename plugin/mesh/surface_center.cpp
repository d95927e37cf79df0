#include "synovia/mesh/surface_center.hpp"
#include "synovia/general/error.hpp"

#include <cmath>
#include <functional>

namespace synovia
{

using namespace mfem;

namespace
{
// Beyond this ratio of singular values a surface is a plane.
constexpr real_t least_bend = 1e-6;

void ForEachPoint(ParMesh &mesh, const Array<int> &boundaries,
                  const std::function<void(const Vector &, real_t)> &visit)
{
   Vector x(3);
   for (int b = 0; b < mesh.GetNBE(); b++)
   {
      if (boundaries.Find(mesh.GetBdrAttribute(b)) < 0)
      {
         continue;
      }
      ElementTransformation &trans = *mesh.GetBdrElementTransformation(b);
      const IntegrationRule &rule =
         IntRules.Get(trans.GetGeometryType(), trans.OrderW() + 4);
      for (int q = 0; q < rule.GetNPoints(); q++)
      {
         trans.SetIntPoint(&rule.IntPoint(q));
         trans.Transform(rule.IntPoint(q), x);
         visit(x, rule.IntPoint(q).weight * trans.Weight());
      }
   }
}

void SumOverRanks(real_t *data, int size, MPI_Comm comm)
{
   MPI_Allreduce(MPI_IN_PLACE, data, size, MPITypeMap<real_t>::mpi_type,
                 MPI_SUM, comm);
}

/// Two unit vectors across a unit vector and each other.
std::array<Point3, 2> Across(const Point3 &axis)
{
   int least = 0;
   for (int d = 1; d < 3; d++)
   {
      least = std::abs(axis[d]) < std::abs(axis[least]) ? d : least;
   }
   Point3 first{{0.0, 0.0, 0.0}};
   first[least] = 1.0;
   first = Sum(first, -axis[least], axis);
   const real_t length = Length(first);
   for (real_t &component : first)
   {
      component /= length;
   }
   return {first, Cross(axis, first)};
}
} // namespace

Point3 CenterOfArea(ParMesh &mesh, const Array<int> &boundaries)
{
   real_t sums[4] = {0.0, 0.0, 0.0, 0.0};
   ForEachPoint(mesh, boundaries,
                [&](const Vector &x, real_t weight)
                {
                   for (int d = 0; d < 3; d++)
                   {
                      sums[d] += weight * x[d];
                   }
                   sums[3] += weight;
                });
   SumOverRanks(sums, 4, mesh.GetComm());
   if (!(sums[3] > 0.0))
   {
      throw Error("a surface without area has no center");
   }
   return {sums[0] / sums[3], sums[1] / sums[3], sums[2] / sums[3]};
}

Point3 CenterOfCircle(ParMesh &mesh, const Array<int> &boundaries,
                      const Point3 &axis_)
{
   const real_t length = Length(axis_);
   if (!(length > 0.0))
   {
      throw Error("the axis of a circle has no direction");
   }
   const Point3 axis{{axis_[0] / length, axis_[1] / length, axis_[2] / length}};
   const std::array<Point3, 2> across = Across(axis);
   const Point3 center = CenterOfArea(mesh, boundaries);

   // Of a . y + b = |y|^2 with y in the plane, from the center of area; the
   // circle's center is a / 2.
   DenseMatrix normal(3);
   normal = 0.0;
   Vector right_side(3);
   right_side = 0.0;
   ForEachPoint(mesh, boundaries,
                [&](const Vector &x, real_t weight)
                {
                   const Point3 from = Sum({x[0], x[1], x[2]}, -1.0, center);
                   const real_t row[3] = {Dot(across[0], from),
                                          Dot(across[1], from), 1.0};
                   const real_t square = row[0] * row[0] + row[1] * row[1];
                   for (int i = 0; i < 3; i++)
                   {
                      right_side[i] += weight * row[i] * square;
                      for (int j = 0; j < 3; j++)
                      {
                         normal(i, j) += weight * row[i] * row[j];
                      }
                   }
                });
   SumOverRanks(normal.Data(), 9, mesh.GetComm());
   SumOverRanks(right_side.GetData(), 3, mesh.GetComm());
   DenseMatrix spread(2);
   for (int i = 0; i < 2; i++)
   {
      for (int j = 0; j < 2; j++)
      {
         spread(i, j) = normal(i, j);
      }
   }
   if (!(spread.CalcSingularvalue(1) >
         least_bend * spread.CalcSingularvalue(0)))
   {
      throw Error("no circle fits a surface that is straight, seen along the "
                  "axis");
   }
   DenseMatrixInverse(normal).Mult(right_side, right_side);
   return Sum(Sum(center, 0.5 * right_side[0], across[0]), 0.5 * right_side[1],
              across[1]);
}

} // namespace synovia
