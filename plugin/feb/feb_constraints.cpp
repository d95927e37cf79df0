#include "synovia/feb/feb_conditions.hpp"
#include "synovia/feb/feb_element_data.hpp"

#include <algorithm>
#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
// Nothing moves across a plane.
void HoldAcross(const Point3 &normal, const std::string &surface,
                const FebInput &where, FebModel &model)
{
   constexpr real_t along_axis = 1.0 - 1e-9;
   BoundaryCase boundary;
   boundary.surfaces = {surface};
   boundary.guide = normal;
   for (int d = 0; d < 3; d++)
   {
      if (std::abs(normal[d]) > along_axis)
      {
         boundary.guide.reset();
         boundary.displacement[d] = LoadCurve(0.0);
      }
   }
   AddCondition(boundary, where, model);
}

void IgnoreEnforcement(const FebInput &constraint)
{
   for (const char *name : {"laugon", "tol", "penalty", "minaug", "maxaug"})
   {
      constraint.Ignore(name, "the displacement across the plane is zero as it "
                              "is prescribed");
   }
   constraint.Expect("rhs", false, "planes that move are not known");
}

// The normal of the plane of a facet.
Point3 NormalOf(const std::vector<int> &facet, const FebMesh &mesh,
                const FebInput &where)
{
   const Point3 &corner = mesh.nodes[facet[0]];
   return UnitVector(Cross(Sum(mesh.nodes[facet[1]], -1.0, corner),
                           Sum(mesh.nodes[facet[2]], -1.0, corner)),
                     where);
}

// Whether all facets are in the plane of the first one.
bool IsPlane(const std::vector<std::vector<int>> &facets, const Point3 &normal,
             const FebMesh &mesh)
{
   // Of the size of the surface.
   constexpr real_t flat = 1e-9;
   const Point3 &first = mesh.nodes[facets[0][0]];
   real_t size = 0.0;
   real_t distance = 0.0;
   for (const std::vector<int> &facet : facets)
   {
      for (const int node : facet)
      {
         const Point3 vector = Sum(mesh.nodes[node], -1.0, first);
         size = std::max(size, Length(vector));
         distance = std::max(distance, std::abs(Dot(normal, vector)));
      }
   }
   return distance <= flat * size;
}

void ReadSymmetryPlane(const FebInput &constraint, FebModel &model)
{
   IgnoreEnforcement(constraint);
   const std::string name = constraint.NeededAttribute("surface");
   const std::string surface = model.surfaces->OfFacets(name, constraint);
   if (surface.empty())
   {
      return;
   }
   const std::vector<std::vector<int>> &facets = model.mesh.surfaces[name];
   const Point3 normal = NormalOf(facets[0], model.mesh, constraint);
   if (IsPlane(facets, normal, model.mesh))
   {
      HoldAcross(normal, surface, constraint, model);
   }
   else
   {
      constraint.Stop("the surface must be a plane");
   }
}

/// Nodes that keep to planes with one normal.
struct KeptNodes
{
   Point3 normal;
   std::vector<int> nodes{};
};

// Coefficients of the displacements of one node are a normal.
void ReadPlaneOfNode(const FebInput &constraint, const FebMesh &mesh,
                     std::vector<KeptNodes> &planes)
{
   constexpr real_t alike = 1.0 - 1e-9;
   const std::string axes = "xyz";
   Point3 normal{{0.0, 0.0, 0.0}};
   std::optional<long long> node;
   for (const FebInput &entry : constraint.All("node"))
   {
      const long long number = entry.NeededNumber("id");
      const std::string dof = entry.NeededAttribute("bc");
      const size_t axis = axes.find(dof);
      if (node.value_or(number) != number || dof.size() != 1 ||
          axis == std::string::npos || mesh.places.count(number) == 0)
      {
         entry.Stop("linear constraints are only known of x, y and z of one "
                    "node, which keeps to a plane");
         return;
      }
      node = number;
      normal[axis] += entry.Number();
   }
   if (!node)
   {
      constraint.Stop("there is no node in it");
      return;
   }
   normal = UnitVector(normal, constraint);
   auto plane =
      std::find_if(planes.begin(), planes.end(),
                   [&](const KeptNodes &other)
                   { return std::abs(Dot(other.normal, normal)) > alike; });
   if (plane == planes.end())
   {
      planes.push_back({normal});
      plane = planes.end() - 1;
   }
   plane->nodes.push_back(mesh.places.at(*node));
}

void ReadLinearConstraint(const FebInput &constraint, FebModel &model)
{
   IgnoreEnforcement(constraint);
   std::vector<KeptNodes> planes;
   for (const FebInput &entry : constraint.All("linear_constraint"))
   {
      ReadPlaneOfNode(entry, model.mesh, planes);
   }
   for (const KeptNodes &plane : planes)
   {
      const std::string name =
         "plane_" + std::to_string(model.mesh.node_sets.size());
      model.mesh.node_sets[name] = plane.nodes;
      const std::string surface = model.surfaces->OfNodes(name, constraint);
      if (!surface.empty())
      {
         HoldAcross(plane.normal, surface, constraint, model);
      }
   }
}
} // namespace

void ReadConstraints(const FebInput &section, FebModel &model)
{
   for (const FebInput &constraint : section.All("constraint"))
   {
      constraint.Attribute("name");
      const std::string type = constraint.NeededAttribute("type");
      if (type == "symmetry plane")
      {
         ReadSymmetryPlane(constraint, model);
      }
      else if (type == "linear constraint")
      {
         ReadLinearConstraint(constraint, model);
      }
      else
      {
         constraint.StopAll("constraints of the type \"" + type +
                            "\" are not known; there are symmetry plane and "
                            "linear constraint");
      }
   }
}

} // namespace synovia
