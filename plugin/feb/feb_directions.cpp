#include "synovia/feb/feb_directions.hpp"

#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
constexpr real_t degree = 0.017453292519943295;
} // namespace

Point3 VectorIn(const FebInput &from, const std::string &child,
                const Point3 &standard)
{
   const std::optional<FebInput> found = from.Find(child);
   return found ? ReadVector(*found) : standard;
}

Point3 DirectionIn(const FebInput &from, const std::string &child,
                   const Point3 &standard)
{
   return UnitVector(VectorIn(from, child, standard), from);
}

Point3 FromAngles(real_t theta, real_t phi)
{
   const real_t a = degree * theta;
   const real_t b = degree * phi;
   return {std::cos(a) * std::sin(b), std::sin(a) * std::sin(b), std::cos(b)};
}

Point3 Turned(const Point3 &from, const Point3 &to, const Point3 &vector)
{
   constexpr real_t opposite = 1e-12;
   const Point3 axis = Cross(from, to);
   const real_t cosine = Dot(from, to);
   if (1.0 + cosine < opposite)
   {
      return {-vector[0], -vector[1], vector[2]};
   }
   const Point3 once = Cross(axis, vector);
   return Sum(Sum(vector, 1.0, once), 1.0 / (1.0 + cosine), Cross(axis, once));
}

std::function<Point3(const FebCell &, int part)>
SphericalVectors(const FebInput &from, const FebElements &elements)
{
   const Point3 center = VectorIn(from, "center", {{0.0, 0.0, 0.0}});
   const Point3 vector = DirectionIn(from, "vector", x_axis);
   return [=](const FebCell &cell, int part)
   {
      const Point3 outward =
         UnitVector(Sum(elements.Center(cell, part), -1.0, center), from);
      return Turned(x_axis, outward, vector);
   };
}

Point3 FromAxis(const Point3 &point, const Point3 &center, const Point3 &axis)
{
   const Point3 vector = Sum(point, -1.0, center);
   return Sum(vector, -Dot(axis, vector), axis);
}

FrameCase CylinderAlongZ(const Point3 &center)
{
   FrameCase frame;
   frame.type = FrameType::cylindrical;
   frame.origin = center;
   frame.axis = z_axis;
   return frame;
}

bool IsAlongZ(const Point3 &axis)
{
   constexpr real_t along = 1.0 - 1e-12;
   return axis[2] > along;
}

std::vector<long long> LocalNodes(const FebInput &from, size_t count,
                                  const FebElements &elements)
{
   const std::optional<FebInput> inner = from.Find("local");
   std::vector<long long> nodes = (inner ? *inner : from).Integers();
   nodes.resize(count, 0);
   for (const int part : elements.parts)
   {
      for (const long long node : nodes)
      {
         if (node > elements.mesh.parts[part].shape->nodes)
         {
            from.Stop("the elements \"" + elements.mesh.parts[part].name +
                      "\" have no node " + std::to_string(node));
            return {};
         }
      }
   }
   return nodes;
}

Point3 FebElements::Center(const FebCell &cell, int part) const
{
   const int corners = mesh.parts[part].shape->corners;
   Point3 sum{{0.0, 0.0, 0.0}};
   for (int i = 0; i < corners; i++)
   {
      sum = Sum(sum, 1.0 / corners, mesh.nodes[cell.nodes[i]]);
   }
   return sum;
}

} // namespace synovia
