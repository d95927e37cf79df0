#include "materials/material_frame.hpp"
#include "general/error.hpp"
#include "general/text.hpp"

#include <cmath>
#include <vector>

namespace synovia
{

using namespace mfem;

namespace
{
using Axis = std::array<real_t, 3>;

Axis Unit(const Axis &a, const std::string &what)
{
   const real_t length = std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
   if (!(length > 0.0) || !std::isfinite(length))
   {
      throw Error("the " + what + " is zero; give a vector");
   }
   return {a[0] / length, a[1] / length, a[2] / length};
}

Axis Product(const Axis &a, const Axis &b)
{
   return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
           a[0] * b[1] - a[1] * b[0]};
}

void SetAxes(const Axis &r, const Axis &theta, const Axis &z, DenseMatrix &axes)
{
   axes.SetSize(3);
   for (int d = 0; d < 3; d++)
   {
      axes(d, 0) = r[d];
      axes(d, 1) = theta[d];
      axes(d, 2) = z[d];
   }
}
} // namespace

CartesianFrame::CartesianFrame(const Axis &theta_)
{
   const Axis theta = Unit(theta_, "axis of a cartesian frame");
   // Any direction that is far from theta leads to one across it.
   int smallest = 0;
   for (int d = 1; d < 3; d++)
   {
      if (std::abs(theta[d]) < std::abs(theta[smallest]))
      {
         smallest = d;
      }
   }
   Axis other{{0.0, 0.0, 0.0}};
   other[smallest] = 1.0;
   const Axis z = Unit(Product(other, theta), "");
   SetAxes(Product(theta, z), theta, z, fixed_axes);
}

void CartesianFrame::GetAxes(const Vector &, DenseMatrix &axes) const
{
   axes = fixed_axes;
}

CylindricalFrame::CylindricalFrame(const Axis &origin_, const Axis &axis_)
   : origin(origin_), axis(Unit(axis_, "axis of a cylindrical frame"))
{
}

void CylindricalFrame::GetAxes(const Vector &point, DenseMatrix &axes) const
{
   Axis r;
   real_t along = 0.0;
   for (int d = 0; d < 3; d++)
   {
      r[d] = point[d] - origin[d];
      along += r[d] * axis[d];
   }
   real_t square = 0.0;
   for (int d = 0; d < 3; d++)
   {
      r[d] -= along * axis[d];
      square += r[d] * r[d];
   }
   const real_t distance = std::sqrt(square);
   MFEM_VERIFY(distance > 0.0, "a cylindrical frame has no r and theta on its "
                               "axis");
   for (int d = 0; d < 3; d++)
   {
      r[d] /= distance;
   }
   SetAxes(r, Product(axis, r), axis, axes);
}

std::string CylindricalFrame::Objection(ElementTransformation &trans) const
{
   const Geometry::Type geometry = trans.GetGeometryType();
   const IntegrationRule &vertices = *Geometries.GetVertices(geometry);
   std::vector<Axis> from_line;
   for (int i = 0; i <= vertices.GetNPoints(); i++)
   {
      Vector x;
      trans.Transform(i < vertices.GetNPoints()
                         ? vertices.IntPoint(i)
                         : Geometries.GetCenter(geometry),
                      x);
      Axis r;
      real_t along = 0.0;
      for (int d = 0; d < 3; d++)
      {
         r[d] = x[d] - origin[d];
         along += r[d] * axis[d];
      }
      for (int d = 0; d < 3; d++)
      {
         r[d] -= along * axis[d];
      }
      from_line.push_back(r);
   }
   // Seen from the line, an element beside it is on one side of it.
   const Axis &centre = from_line.back();
   for (const Axis &r : from_line)
   {
      if (!(r[0] * centre[0] + r[1] * centre[1] + r[2] * centre[2] > 0.0))
      {
         Vector x;
         trans.Transform(Geometries.GetCenter(geometry), x);
         return "the axis of its cylindrical frame runs through or along the "
                "element at (" +
                ToText(x[0]) + ", " + ToText(x[1]) + ", " + ToText(x[2]) +
                "), where r and theta mean nothing; move the origin of the "
                "frame off the body";
      }
   }
   return "";
}

} // namespace synovia
