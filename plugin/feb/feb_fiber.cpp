#include "synovia/feb/feb_axes.hpp"
#include "synovia/feb/feb_directions.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
FebDirection LocalFiber(const FebInput &from, const FebElements &elements)
{
   std::vector<long long> nodes = LocalNodes(from, 2, elements);
   FebDirection result;
   if (nodes.empty())
   {
      return result;
   }
   if (nodes[0] <= 0 && nodes[1] <= 0)
   {
      nodes = {1, 2};
   }
   if (nodes[0] <= 0 || nodes[1] <= 0)
   {
      from.Stop("both nodes must be there");
      return result;
   }
   const FebMesh &mesh = elements.mesh;
   result.of_element = [nodes, &mesh, from](const FebCell &cell, int)
   {
      return UnitVector(Sum(mesh.nodes[cell.nodes[nodes[1] - 1]], -1.0,
                            mesh.nodes[cell.nodes[nodes[0] - 1]]),
                        from);
   };
   return result;
}

FebDirection SphericalFiber(const FebInput &from, const FebElements &elements)
{
   FebDirection result;
   result.at_centers = true;
   result.of_element = SphericalVectors(from, elements);
   return result;
}

FebDirection CylindricalFiber(const FebInput &from, const FebElements &elements)
{
   const Point3 center = VectorIn(from, "center", {{0.0, 0.0, 0.0}});
   const Point3 axis = DirectionIn(from, "axis", z_axis);
   FebDirection result;
   const Point3 vector = DirectionIn(from, "vector", x_axis);
   result.direction = vector;
   if (IsAlongZ(axis))
   {
      result.cylinder = CylinderAlongZ(center);
   }
   result.at_centers = true;
   const Point3 first = Turned(z_axis, axis, x_axis);
   result.of_element = [=](const FebCell &cell, int part)
   {
      const Point3 outward =
         UnitVector(FromAxis(elements.Center(cell, part), center, axis), from);
      return Turned(first, outward, vector);
   };
   return result;
}

FebDirection MappedFiber(const FebInput &from,
                         const FebElementData::Vectors &vectors)
{
   FebDirection result;
   result.of_element = [&vectors, from](const FebCell &cell, int)
   {
      const auto found = vectors.find(cell.number);
      if (found == vectors.end())
      {
         from.Stop("element " + std::to_string(cell.number) +
                   " has no direction");
         return x_axis;
      }
      return found->second;
   };
   return result;
}
} // namespace

FebDirection ReadFiber(const FebInput &law, const FebElements &elements)
{
   const std::optional<FebInput> from = law.Find("fiber");
   if (elements.AreIn(elements.data.fibers))
   {
      law.Ignore("fiber", "MeshData has the directions");
      return MappedFiber(law, elements.data.fibers);
   }
   FebDirection result;
   if (!from)
   {
      return result;
   }
   const std::string type = from->NeededAttribute("type");
   if (type == "angles")
   {
      result.direction =
         FromAngles(from->Number("theta", 0.0), from->Number("phi", 90.0));
      return result;
   }
   if (type == "vector")
   {
      const std::optional<FebInput> inner = from->Find("vector");
      result.direction = UnitVector(ReadVector(inner ? *inner : *from), *from);
      return result;
   }
   if (type == "local")
   {
      return LocalFiber(*from, elements);
   }
   if (type == "spherical")
   {
      return SphericalFiber(*from, elements);
   }
   if (type == "cylindrical")
   {
      return CylindricalFiber(*from, elements);
   }
   if (type == "map")
   {
      const auto found = elements.data.maps.find(from->Text());
      if (found != elements.data.maps.end())
      {
         return MappedFiber(*from, found->second);
      }
      from->Stop("MeshData has no vectors called \"" + from->Text() + "\"");
      return result;
   }
   from->StopAll("fibers of the type \"" + type +
                 "\" are not known; there are angles, vector, local, "
                 "cylindrical, spherical, map");
   return result;
}

} // namespace synovia
