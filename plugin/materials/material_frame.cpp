#include "synovia/materials/material_frame.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/text.hpp"

#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
Point3 Unit(const Point3 &a, const std::string &what)
{
   const real_t length = Length(a);
   if (!(length > 0.0) || !std::isfinite(length))
   {
      throw Error("the " + what + " is zero; give a vector");
   }
   return {a[0] / length, a[1] / length, a[2] / length};
}

} // namespace

Tensor3<> AxesOf(const Point3 &r, const Point3 &theta, const Point3 &z)
{
   return {
      {{r[0], theta[0], z[0]}, {r[1], theta[1], z[1]}, {r[2], theta[2], z[2]}}};
}

Tensor3<> AxesAlong(const Point3 &theta_)
{
   const Point3 theta = Unit(theta_, "direction of fibers");
   // Any direction that is far from theta leads to one across it.
   int smallest = 0;
   for (int d = 1; d < 3; d++)
   {
      if (std::abs(theta[d]) < std::abs(theta[smallest]))
      {
         smallest = d;
      }
   }
   Point3 other{{0.0, 0.0, 0.0}};
   other[smallest] = 1.0;
   const Point3 z = Unit(Cross(other, theta), "");
   return AxesOf(Cross(theta, z), theta, z);
}

CartesianFrame::CartesianFrame(const Point3 &theta)
   : axes(AxesAlong(Unit(theta, "axis of a cartesian frame")))
{
}

CylindricalFrame::CylindricalFrame(const Point3 &origin_, const Point3 &axis_)
   : origin(origin_), axis(Unit(axis_, "axis of a cylindrical frame"))
{
}

Point3 CylindricalFrame::FromLine(const Vector &point) const
{
   const Point3 r = Sum({point[0], point[1], point[2]}, -1.0, origin);
   return Sum(r, -Dot(r, axis), axis);
}

Tensor3<> CylindricalFrame::GetAxes(const MaterialPoint &point) const
{
   // In memory of this call: it is made at each point of each evaluation.
   real_t coordinates[3];
   Vector x(coordinates, 3);
   point.trans.Transform(point.ip, x);
   const Point3 r = FromLine(x);
   const real_t distance = Length(r);
   MFEM_VERIFY(distance > 0.0, "a cylindrical frame has no r and theta on its "
                               "axis");
   const Point3 outward{{r[0] / distance, r[1] / distance, r[2] / distance}};
   return AxesOf(outward, Cross(axis, outward), axis);
}

std::string CylindricalFrame::Validate(ElementTransformation &trans) const
{
   const Geometry::Type geometry = trans.GetGeometryType();
   const IntegrationRule &vertices = *Geometries.GetVertices(geometry);
   Vector center;
   trans.Transform(Geometries.GetCenter(geometry), center);
   const Point3 to_center = FromLine(center);
   // Seen from the line, an element beside it is on one side of it.
   bool beside = Dot(to_center, to_center) > 0.0;
   for (int i = 0; i < vertices.GetNPoints(); i++)
   {
      Vector x;
      trans.Transform(vertices.IntPoint(i), x);
      beside = beside && Dot(FromLine(x), to_center) > 0.0;
   }
   return beside ? ""
                 : "the axis of its cylindrical frame runs through or along "
                   "the element at (" +
                      ToText(center[0]) + ", " + ToText(center[1]) + ", " +
                      ToText(center[2]) +
                      "), where r and theta mean nothing; move the origin of "
                      "the frame off the body";
}

} // namespace synovia
