#include "synovia/feb/feb_axes.hpp"
#include "synovia/feb/feb_directions.hpp"

#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
Tensor3<> AxesFromAngles(real_t theta, real_t phi)
{
   const Point3 a = FromAngles(theta, phi);
   const Point3 b = FromAngles(theta + 90.0, 90.0);
   return InColumns({a, b, Cross(a, b)});
}

// What is parallel to the first axis is no second one.
Point3 Beside(const Point3 &first, const Point3 &second, const Point3 &other,
              real_t parallel)
{
   return std::abs(Dot(first, second)) > parallel ? other : second;
}

FebAxes LocalAxes(const FebInput &from, const FebElements &elements)
{
   std::vector<long long> nodes = LocalNodes(from, 3, elements);
   FebAxes result;
   if (nodes.empty())
   {
      return result;
   }
   if (nodes[0] <= 0 && nodes[1] <= 0 && nodes[2] <= 0)
   {
      nodes = {1, 2, 4};
   }
   if (nodes[0] <= 0 || nodes[1] <= 0)
   {
      from.Stop("the first two nodes must be there");
      return result;
   }
   const FebMesh &mesh = elements.mesh;
   result.of_element = [nodes, &mesh, from](const FebCell &cell, int)
   {
      const auto at = [&](long long n)
      { return mesh.nodes[cell.nodes[n - 1]]; };
      constexpr real_t parallel = 0.999;
      const Point3 a = UnitVector(Sum(at(nodes[1]), -1.0, at(nodes[0])), from);
      const Point3 d = nodes[2] > 0 && nodes[2] != nodes[1]
                          ? Sum(at(nodes[2]), -1.0, at(nodes[0]))
                          : Beside(a, y_axis, x_axis, parallel);
      return AxesAcross(a, d, from);
   };
   return result;
}

constexpr real_t almost_parallel = 0.99;

// In axes of its own.
Tensor3<> AxesWith(const Point3 &vector, const FebInput &from)
{
   return AxesAcross(vector, Beside(vector, y_axis, z_axis, almost_parallel),
                     from);
}

FebAxes CylindricalAxes(const FebInput &from, const FebElements &elements)
{
   const Point3 center = VectorIn(from, "center", {{0.0, 0.0, 0.0}});
   const Point3 axis = DirectionIn(from, "axis", z_axis);
   const Point3 vector = DirectionIn(from, "vector", x_axis);
   FebAxes result;
   result.axes = AxesWith(vector, from);
   if (IsAlongZ(axis))
   {
      result.cylinder = CylinderAlongZ(center);
   }
   result.at_centers = true;
   result.of_element = [=](const FebCell &cell, int part)
   {
      const Point3 outward =
         UnitVector(FromAxis(elements.Center(cell, part), center, axis), from);
      std::array<Point3, 3> columns;
      for (int j = 0; j < 3; j++)
      {
         columns[j] =
            Turned(x_axis, outward,
                   {result.axes[0][j], result.axes[1][j], result.axes[2][j]});
      }
      return InColumns(columns);
   };
   return result;
}

FebAxes SphericalAxes(const FebInput &from, const FebElements &elements)
{
   FebAxes result;
   result.at_centers = true;
   result.of_element = [from, vectors = SphericalVectors(from, elements)](
                          const FebCell &cell, int part)
   { return AxesWith(vectors(cell, part), from); };
   return result;
}

FebAxes UniformAxes(const Tensor3<> &axes)
{
   FebAxes result;
   result.axes = axes;
   return result;
}
} // namespace

FebAxes ReadAxes(const FebInput &material, const FebElements &elements)
{
   const FebAxes of_space = UniformAxes(IdentityTensor());
   if (elements.AreIn(elements.data.axes))
   {
      FebAxes result;
      result.of_element = [&data = elements.data](const FebCell &cell, int)
      {
         const auto found = data.axes.find(cell.number);
         return found == data.axes.end() ? IdentityTensor() : found->second;
      };
      return result;
   }
   const std::optional<FebInput> from = material.Find("mat_axis");
   if (!from)
   {
      return of_space;
   }
   const std::string type = from->NeededAttribute("type");
   if (type == "vector")
   {
      return UniformAxes(AxesAcross(VectorIn(*from, "a", x_axis),
                                    VectorIn(*from, "d", y_axis), *from));
   }
   if (type == "angles")
   {
      return UniformAxes(
         AxesFromAngles(from->Number("theta", 0.0), from->Number("phi", 90.0)));
   }
   if (type == "local")
   {
      return LocalAxes(*from, elements);
   }
   if (type == "cylindrical")
   {
      return CylindricalAxes(*from, elements);
   }
   if (type == "spherical")
   {
      return SphericalAxes(*from, elements);
   }
   from->StopAll("material axes of the type \"" + type +
                 "\" are not known; there are vector, angles, local, "
                 "cylindrical, spherical");
   return of_space;
}

} // namespace synovia
