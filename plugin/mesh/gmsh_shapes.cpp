#include "synovia/mesh/gmsh_shapes.hpp"
#include "synovia/general/point3.hpp"
#include "synovia/mesh/face_sides.hpp"

#include <algorithm>
#include <numeric>

namespace synovia
{

using namespace mfem;

namespace
{
// Those of Bergot et al. among MFEM's pyramids.
constexpr int pyramids_of_gmsh = 0;

// Whether a point of the lattice of a cube belongs to an element of order p.
bool IsInside(Geometry::Type geometry, int p, int i, int j, int k)
{
   switch (geometry)
   {
   case Geometry::TETRAHEDRON:
      return i + j + k <= p;
   case Geometry::PRISM:
      return i + j <= p;
   case Geometry::PYRAMID:
      return std::max(i, j) + k <= p;
   default:
      return true;
   }
}

// Places in MFEM's element of the nodes of the complete type.
std::vector<Point3> NodesOf(const GmshElementType &type)
{
   const int p = type.order;
   const std::vector<int> places = GmshNodesOfLattice(type.geometry, p);
   std::vector<Point3> nodes(places.size());
   auto place = places.begin();
   for (int k = 0; k <= p; k++)
   {
      for (int j = 0; j <= p; j++)
      {
         for (int i = 0; i <= p; i++)
         {
            if (IsInside(type.geometry, p, i, j, k))
            {
               nodes[*place++] = Sum({{0.0, 0.0, 0.0}}, 1.0 / p,
                                     {{1.0 * i, 1.0 * j, 1.0 * k}});
            }
         }
      }
   }
   return nodes;
}

/// The complete type of the same geometry and order, by MFEM's functions.
class CompleteElement
{
public:
   explicit CompleteElement(const GmshElementType &type)
      : collection(type.order, 3, BasisType::ClosedUniform, pyramids_of_gmsh),
        element(*collection.FiniteElementForGeometry(type.geometry)),
        reference(NodesOf(type))
   {
      const IntegrationRule &points = element.GetNodes();
      for (int i = 0; i < points.GetNPoints(); i++)
      {
         const IntegrationPoint &point = points.IntPoint(i);
         nodes_of_dofs.push_back(NodeAt({{point.x, point.y, point.z}}));
      }
   }

   const Point3 &Reference(int node) const { return reference[node]; }
   int NodeAt(const Point3 &point) const
   {
      for (size_t i = 0; i < reference.size(); i++)
      {
         if (Length(Sum(reference[i], -1.0, point)) < 1e-6)
         {
            return static_cast<int>(i);
         }
      }
      MFEM_ABORT("no node is there");
      return -1;
   }
   std::vector<double> Values(const IntegrationPoint &point) const
   {
      Vector by_dof(element.GetDof());
      element.CalcShape(point, by_dof);
      std::vector<double> values(nodes_of_dofs.size());
      for (size_t i = 0; i < values.size(); i++)
      {
         values[nodes_of_dofs[i]] = by_dof[static_cast<int>(i)];
      }
      return values;
   }

private:
   H1_FECollection collection;
   const FiniteElement &element;
   /// In MFEM's element.
   std::vector<Point3> reference;
   std::vector<int> nodes_of_dofs;
};

Point3 Mean(const std::vector<Point3> &points)
{
   Point3 mean{{0.0, 0.0, 0.0}};
   for (const Point3 &point : points)
   {
      mean = Sum(mean, 1.0 / points.size(), point);
   }
   return mean;
}

// Hands what nodes within faces and elements weigh to those that an incomplete
// element of order 2 has. At the center of a quadrilateral the functions of its
// 8 nodes are -1/4 for corners and 1/2 for edges; at that of a hexahedron,
// those of its 20 nodes are -1/4 and 1/4.
void FoldOntoEdges(const CompleteElement &element, const GmshElementType &type,
                   std::vector<double> &values)
{
   std::vector<int> corners(type.corners);
   std::iota(corners.begin(), corners.end(), 0);
   if (type.geometry == Geometry::CUBE)
   {
      const double center = values.back();
      for (int i = 0; i < type.nodes; i++)
      {
         values[i] += (i < type.corners ? -0.25 : 0.25) * center;
      }
   }
   for (int face = 0; face < Geometry::NumFaces[type.geometry]; face++)
   {
      const auto nodes = FaceVertices(type.geometry, corners.data(), face);
      if (nodes[3] < 0)
      {
         continue;
      }
      std::vector<Point3> ends;
      for (const int node : nodes)
      {
         ends.push_back(element.Reference(node));
      }
      const double center = values[element.NodeAt(Mean(ends))];
      for (int i = 0; i < 4; i++)
      {
         const Point3 middle = Mean({ends[i], ends[(i + 1) % 4]});
         values[nodes[i]] -= 0.25 * center;
         values[element.NodeAt(middle)] += 0.5 * center;
      }
   }
   values.resize(type.nodes);
}
} // namespace

std::vector<int> MirroredNodes(const GmshElementType &type)
{
   const CompleteElement element(type);
   const bool triangular = type.geometry == Geometry::TETRAHEDRON ||
                           type.geometry == Geometry::PRISM;
   // A pyramid's layers shrink towards its apex, at x = 0.
   const double shrinks = type.geometry == Geometry::PYRAMID ? 1.0 : 0.0;
   std::vector<int> order;
   for (int i = 0; i < type.nodes; i++)
   {
      const Point3 &at = element.Reference(i);
      const Point3 image =
         triangular ? Point3{{at[1], at[0], at[2]}}
                    : Point3{{1.0 - shrinks * at[2] - at[0], at[1], at[2]}};
      order.push_back(element.NodeAt(image));
   }
   return order;
}

std::vector<double> BasisAtNodalPoints(const GmshElementType &type, int order)
{
   const CompleteElement element(type);
   const H1_FECollection nodal(order, 3);
   const IntegrationRule &points =
      nodal.FiniteElementForGeometry(type.geometry)->GetNodes();
   std::vector<double> basis;
   for (int i = 0; i < points.GetNPoints(); i++)
   {
      std::vector<double> values = element.Values(points.IntPoint(i));
      if (type.serendipity)
      {
         FoldOntoEdges(element, type, values);
      }
      basis.insert(basis.end(), values.begin(), values.end());
   }
   return basis;
}

} // namespace synovia
