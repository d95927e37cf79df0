#include "synovia/checks/surface_conditions.hpp"
#include "synovia/checks/layer_loads.hpp"
#include "synovia/mesh/named_boundaries.hpp"

namespace synovia
{

using namespace mfem;

void SurfaceConditions::Add(const BoundaryCase &boundary,
                            Conditions &conditions) const
{
   conditions.none = false;
   for (int d = 0; d < 3; d++)
   {
      if (boundary.displacement[d])
      {
         conditions.displaced[d] = true;
         conditions.moving =
            conditions.moving || Amplitude(*boundary.displacement[d]) > 0.0;
      }
   }
   conditions.loaded = conditions.loaded || boundary.traction ||
                       boundary.normal_traction || boundary.effective_traction;
   conditions.springs =
      conditions.springs || boundary.spring.stiffness > 0.0 || boundary.guide;
   conditions.force = conditions.force || boundary.force.curve;
   conditions.pressure = conditions.pressure || boundary.pressure;
   conditions.sealed = conditions.sealed || boundary.sealed;
   conditions.flux =
      conditions.flux || boundary.normal_flux || boundary.mixture_flux;
}

SurfaceConditions::SurfaceConditions(const CaseFile &setup,
                                     const NamedMesh &mesh)
   : by_attribute(mesh.Get().bdr_attributes.IsEmpty()
                     ? 1
                     : mesh.Get().bdr_attributes.Max() + 1)
{
   for (const BoundaryCase &boundary : setup.boundaries)
   {
      for (const std::string &name : boundary.surfaces)
      {
         for (const int attribute : mesh.Boundary(name))
         {
            Add(boundary, by_attribute[attribute]);
         }
      }
   }
   for (const RigidBodyCase &body : setup.rigid_bodies)
   {
      for (const int attribute : TiedSurfaces(body, mesh))
      {
         by_attribute[attribute].none = false;
         by_attribute[attribute].rigid = true;
      }
   }
   for (const int attribute : GluedSurfaces(setup, mesh))
   {
      by_attribute[attribute].none = false;
      by_attribute[attribute].tied = true;
   }
   for (const int attribute : ContactSurfaces(setup, mesh))
   {
      by_attribute[attribute].none = false;
      by_attribute[attribute].contact = true;
   }
}

bool SurfaceConditions::IsSymmetry(int attribute, int axis) const
{
   const Conditions &c = by_attribute[attribute];
   return c.displaced[axis] && !c.displaced[(axis + 1) % 3] &&
          !c.displaced[(axis + 2) % 3] && !c.moving;
}

std::string SurfaceConditions::Text(int attribute) const
{
   const Conditions &c = by_attribute[attribute];
   std::string solid;
   const auto add = [&solid](bool there, const std::string &word)
   {
      if (there)
      {
         solid += (solid.empty() ? "" : ", ") + word;
      }
   };
   std::string components;
   for (int d = 0; d < 3; d++)
   {
      components += c.displaced[d] ? std::string(1, "xyz"[d]) : "";
   }
   add(!components.empty(), "displacement " + components);
   add(c.rigid, "rigid body");
   add(c.force, "force");
   add(c.springs, "springs");
   add(c.loaded, "traction");
   add(c.contact, "contact");
   add(c.tied, "tied");
   add(solid.empty(), "traction-free");
   add(c.pressure, "pressure");
   add(c.flux, "flux");
   add(c.sealed || (!c.pressure && !c.flux && !c.contact && !c.tied), "sealed");
   return solid;
}

} // namespace synovia
