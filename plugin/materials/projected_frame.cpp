#include "synovia/materials/projected_frame.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/text.hpp"
#include "synovia/mesh/nearest_normals.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
// Of the vector's length: where less of it is left its direction is a matter of
// chance.
constexpr real_t least_projection = 1e-3;

Point3 CenterOf(ElementTransformation &trans)
{
   Vector center(3);
   trans.Transform(Geometries.GetCenter(trans.GetGeometryType()), center);
   return {center[0], center[1], center[2]};
}
} // namespace

ProjectedFrame::ProjectedFrame(NamedMesh &mesh, const Array<int> &boundaries,
                               const Point3 &direction)
   : ElementFrame(mesh.Get().GetNE())
{
   const real_t length = Length(direction);
   if (!(length > 0.0) || !std::isfinite(length))
   {
      throw Error("the direction to project on surfaces is zero; give a "
                  "vector");
   }
   const NearestNormals normals(mesh.Get(), boundaries);
   for (int i = 0; i < mesh.Get().GetNE(); i++)
   {
      const Point3 z =
         normals(CenterOf(*mesh.Get().GetElementTransformation(i)));
      const Point3 along = Sum(direction, -Dot(direction, z), z);
      if (Length(along) > least_projection * length)
      {
         const Point3 theta = Sum({0.0, 0.0, 0.0}, 1.0 / Length(along), along);
         axes[i] = AxesOf(Cross(theta, z), theta, z);
      }
   }
}

std::string ProjectedFrame::Validate(ElementTransformation &trans) const
{
   if (HasAxes(trans))
   {
      return "";
   }
   const Point3 center = CenterOf(trans);
   return "the direction that a frame projects on surfaces is along their "
          "normal at the element at (" +
          ToText(center[0]) + ", " + ToText(center[1]) + ", " +
          ToText(center[2]) + "), so that it has none along them; give another";
}

} // namespace synovia
