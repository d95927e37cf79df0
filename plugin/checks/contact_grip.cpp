#include "synovia/checks/contact_grip.hpp"
#include "synovia/cases/case_problem.hpp"
#include "synovia/checks/body_shape.hpp"
#include "synovia/checks/layer_loads.hpp"
#include "synovia/checks/triangulated_surface.hpp"
#include "synovia/general/reduce_lists.hpp"

#include <algorithm>
#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
// Contact pushes along an axis if the surfaces that face it are at least this
// part of all, seen along it.
constexpr real_t least_part = 0.02;

// The contact surfaces of each body, seen along x, y and z from above and below
// (6 values), and their area.
constexpr int views = 7;

std::vector<real_t> SeenAreas(const Array<int> &touching, ParMesh &mesh,
                              const std::vector<Body> &bodies)
{
   const std::vector<int> body_of =
      BodyOfRegions(bodies, mesh.attributes.Max());
   std::vector<real_t> areas(views * bodies.size(), 0.0);
   for (int i = 0; i < mesh.GetNBE(); i++)
   {
      if (touching.Find(mesh.GetBdrAttribute(i)) < 0)
      {
         continue;
      }
      real_t *const seen = &areas[views * body_of[RegionBehind(mesh, i)]];
      for (const Triangle &triangle : Triangulate(mesh, i))
      {
         const Point3 area = AreaVector(triangle);
         for (int d = 0; d < 3; d++)
         {
            seen[area[d] > 0.0 ? d : 3 + d] += std::abs(area[d]);
         }
         seen[6] += Length(area);
      }
   }
   SumOverRanks(areas, mesh.GetComm());
   return areas;
}

void AddLoads(const BoundaryCase &boundary, ContactGrip &grip)
{
   for (int d = 0; d < 3; d++)
   {
      grip.driven[d] = grip.driven[d] || boundary.force.Drives(d);
      grip.loaded[d] =
         grip.loaded[d] || grip.driven[d] || boundary.normal_traction ||
         (boundary.traction && Amplitude((*boundary.traction)[d]) > 0.0);
   }
}
} // namespace

std::vector<ContactGrip> FindContactGrips(const CaseFile &setup,
                                          NamedMesh &mesh,
                                          const std::vector<Body> &bodies)
{
   const std::vector<real_t> areas =
      SeenAreas(ContactSurfaces(setup, mesh), mesh.Get(), bodies);
   std::vector<ContactGrip> grips(bodies.size());
   for (size_t b = 0; b < bodies.size(); b++)
   {
      const real_t *const seen = &areas[views * b];
      for (int d = 0; d < 3; d++)
      {
         grips[b].pushes_down[d] = seen[d] > least_part * seen[6];
         grips[b].pushes_up[d] = seen[3 + d] > least_part * seen[6];
      }
      for (const BoundaryCase &boundary : setup.boundaries)
      {
         Array<int> surfaces;
         for (const std::string &name : boundary.surfaces)
         {
            surfaces.Append(mesh.Boundary(name));
         }
         if (bodies[b].Touches(surfaces))
         {
            AddLoads(boundary, grips[b]);
         }
      }
   }
   return grips;
}

} // namespace synovia
