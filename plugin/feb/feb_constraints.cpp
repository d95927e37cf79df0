#include "synovia/feb/feb_model.hpp"

#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
// Relative to the size of the surface.
constexpr real_t flat = 1e-9;

// The axis that all points have the same coordinate along; -1 if there is none.
int FlatAxis(const std::vector<Point3> &points)
{
   Point3 low = points[0];
   Point3 high = points[0];
   for (const Point3 &point : points)
   {
      for (int d = 0; d < 3; d++)
      {
         low[d] = std::min(low[d], point[d]);
         high[d] = std::max(high[d], point[d]);
      }
   }
   const real_t size = Length(Sum(high, -1.0, low));
   for (int d = 0; d < 3; d++)
   {
      if (high[d] - low[d] <= flat * size)
      {
         return d;
      }
   }
   return -1;
}

// Nothing moves across a plane.
void ReadSymmetryPlane(const FebInput &constraint, FebModel &model)
{
   for (const char *name : {"laugon", "tol", "penalty", "minaug", "maxaug"})
   {
      constraint.Ignore(name, "the displacement across the plane is zero as it "
                              "is prescribed");
   }
   constraint.Expect("rhs", false, "planes that move are not known");
   const std::string name = constraint.NeededAttribute("surface");
   const std::string surface = model.surfaces->OfFacets(name, constraint);
   const std::vector<int> *nodes =
      model.surfaces->FindNodes("@surface:" + name);
   if (surface.empty() || !nodes || nodes->empty())
   {
      return;
   }
   std::vector<Point3> points;
   for (const int node : *nodes)
   {
      points.push_back(model.mesh.nodes[node]);
   }
   const int axis = FlatAxis(points);
   if (axis < 0)
   {
      constraint.Stop("the surface must be a plane across x, y or z");
      return;
   }
   BoundaryCase boundary;
   boundary.surfaces = {surface};
   boundary.displacement[axis] = LoadCurve(0.0);
   model.setup.boundaries.push_back(boundary);
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
      else
      {
         constraint.StopAll("constraints of the type \"" + type +
                            "\" are not known; there is symmetry plane");
      }
   }
}

} // namespace synovia
