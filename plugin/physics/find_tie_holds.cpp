#include "synovia/physics/find_tie_holds.hpp"
#include "synovia/mesh/boundary_marker.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
void SortUnique(Array<int> &dofs)
{
   dofs.Sort();
   dofs.Unique();
}
} // namespace

TieHolds FindTieHolds(BiphasicSpaces &spaces,
                      const BoundaryConditions &conditions,
                      const RigidTies &rigid,
                      const std::vector<ContactPair *> &pairs,
                      const std::vector<const TiedInterface *> &before)
{
   TieHolds holds;
   holds.prescribed = conditions.DisplacementDofs();
   holds.prescribed_pressures = conditions.PressureDofs();
   holds.moved = rigid.Dofs();
   for (const DrivenSurface &surface : conditions.DrivenSurfaces())
   {
      const Array<int> marker =
         BoundaryMarker(spaces.GetMesh(), surface.boundary);
      for (int d = 0; d < 3; d++)
      {
         if (surface.direction[d] != 0.0)
         {
            Array<int> dofs;
            spaces.Displacement().GetEssentialTrueDofs(marker, dofs, d);
            holds.moved.Append(dofs);
         }
      }
   }
   for (const ContactPair *pair : pairs)
   {
      const ContactGeometry &geometry = pair->Geometry();
      holds.moved_pressures.Append(geometry.Source().PressureTrueDofs());
      holds.moved_pressures.Append(geometry.Destination().PressureTrueDofs());
   }
   for (const TiedInterface *tie : before)
   {
      for (const ContactSurface *side : {&tie->Source(), &tie->Destination()})
      {
         holds.moved.Append(side->DisplacementTrueDofs());
         if (tie->Scales().exchanges)
         {
            holds.moved_pressures.Append(side->PressureTrueDofs());
         }
      }
   }
   SortUnique(holds.moved);
   SortUnique(holds.moved_pressures);
   return holds;
}

} // namespace synovia
