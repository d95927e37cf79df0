#include "mesh/gmsh_shapes.hpp"
#include "general/error.hpp"

#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{

bool StartsWith(const std::string &text, const std::string &start)
{
   return text.compare(0, start.size(), start) == 0;
}

// gmsh's high order functions lose digits, and some are not implemented: they
// have to be 1 at their own node and 0 at the others.
constexpr double nodal_tolerance = 1e-5;

bool IsNodal(const std::vector<double> &basis, int nodes)
{
   if (basis.size() != static_cast<size_t>(nodes) * nodes)
   {
      return false;
   }
   for (int i = 0; i < nodes; i++)
   {
      for (int j = 0; j < nodes; j++)
      {
         const double expected = i == j ? 1.0 : 0.0;
         if (!(std::abs(basis[i * nodes + j] - expected) < nodal_tolerance))
         {
            return false;
         }
      }
   }
   return true;
}

} // namespace

Geometry::Type GeometryOf(const GmshElementType &type)
{
   // Some types have no corners but one node in the middle.
   if (type.dimension != 3 || type.nodes < type.corners || type.corners < 4)
   {
      return Geometry::INVALID;
   }
   return StartsWith(type.name, "Tetrahedron")  ? Geometry::TETRAHEDRON
          : StartsWith(type.name, "Hexahedron") ? Geometry::CUBE
          : StartsWith(type.name, "Prism")      ? Geometry::PRISM
          : StartsWith(type.name, "Pyramid")    ? Geometry::PYRAMID
                                                : Geometry::INVALID;
}

std::vector<double> ToGmsh(const GmshElementType &type,
                           const IntegrationRule &points)
{
   const Geometry::Type geometry = GeometryOf(type);
   // The corners at the ends of the three axes that start at corner 0.
   const bool triangular =
      geometry == Geometry::TETRAHEDRON || geometry == Geometry::PRISM;
   const int y = triangular ? 2 : 3;
   const double *const corner = type.reference.data();
   std::vector<double> result;
   for (int i = 0; i < points.GetNPoints(); i++)
   {
      const IntegrationPoint &point = points.IntPoint(i);
      for (int d = 0; d < 3; d++)
      {
         const double origin = corner[d];
         result.push_back(origin + point.x * (corner[3 + d] - origin) +
                          point.y * (corner[3 * y + d] - origin) +
                          point.z * (corner[3 * y + 3 + d] - origin));
      }
   }
   return result;
}

std::vector<int> MirroredNodes(const GmshElementType &type)
{
   const Geometry::Type geometry = GeometryOf(type);
   const bool triangular =
      geometry == Geometry::TETRAHEDRON || geometry == Geometry::PRISM;
   std::vector<int> order;
   for (int i = 0; i < type.nodes; i++)
   {
      const double *const at = type.reference.data() + 3 * i;
      const double image[3] = {triangular ? at[1] : -at[0],
                               triangular ? at[0] : at[1], at[2]};
      int nearest = -1;
      for (int j = 0; j < type.nodes; j++)
      {
         const double *const other = type.reference.data() + 3 * j;
         const double distance = std::hypot(
            image[0] - other[0], image[1] - other[1], image[2] - other[2]);
         nearest = distance < 1e-6 ? j : nearest;
      }
      MFEM_VERIFY(nearest >= 0, type.name << " has no mirror image");
      order.push_back(nearest);
   }
   return order;
}

std::vector<double> BasisAtNodalPoints(GmshElementTypes &types, int number,
                                       int order)
{
   const GmshElementType &type = types.Get(number);
   if (!IsNodal(types.Basis(number, type.reference), type.nodes))
   {
      throw Error("elements of gmsh's type \"" + type.name + "\" of order " +
                  std::to_string(type.order) + " are not supported");
   }
   const H1_FECollection nodal(order, 3);
   const FiniteElement &element =
      *nodal.FiniteElementForGeometry(GeometryOf(type));
   return types.Basis(number, ToGmsh(type, element.GetNodes()));
}

} // namespace synovia
