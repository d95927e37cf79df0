#include "synovia/physics/contact_drainage.hpp"
#include "synovia/mesh/boundary_marker.hpp"

namespace synovia
{

using namespace mfem;

ContactDrainage::ContactDrainage(BiphasicSpaces &spaces_,
                                 const std::vector<ContactPair *> &pairs_,
                                 const Array<int> &sealed)
   : spaces(spaces_), pairs(pairs_)
{
   Array<int> draining;
   for (const ContactPair *pair : pairs)
   {
      draining.Append(pair->Geometry().Source().Boundary());
      draining.Append(pair->Geometry().Destination().Boundary());
   }
   Array<int> marker = BoundaryMarker(spaces.GetMesh(), draining);
   for (const int attribute : sealed)
   {
      marker[attribute - 1] = 0;
   }
   spaces.Pressure().GetEssentialTrueDofs(marker, dofs);
   if (&spaces.Multiplier() != &spaces.Pressure())
   {
      vertex_interpolation = std::make_unique<ParDiscreteLinearOperator>(
         &spaces.Multiplier(), &spaces.Pressure());
      vertex_interpolation->AddDomainInterpolator(new IdentityInterpolator);
      vertex_interpolation->Assemble();
      vertex_interpolation->Finalize();
      vertices_to_pressure.reset(vertex_interpolation->ParallelAssemble());
   }
}

Array<int> ContactDrainage::OpenDofs() const
{
   Array<int> open;
   if (pairs.empty())
   {
      return open;
   }
   Vector sealed(spaces.Multiplier().GetTrueVSize());
   sealed = 0.0;
   for (const ContactPair *pair : pairs)
   {
      pair->MarkSealed(sealed);
   }
   Vector sealed_pressure(spaces.Pressure().GetTrueVSize());
   if (vertices_to_pressure)
   {
      vertices_to_pressure->Mult(sealed, sealed_pressure);
   }
   else
   {
      sealed_pressure = sealed;
   }
   sealed_pressure.HostRead();
   for (const int dof : dofs)
   {
      // A dof between vertices is sealed where all of them are.
      if (sealed_pressure[dof] < 1.0 - 1e-8)
      {
         open.Append(dof);
      }
   }
   return open;
}

} // namespace synovia
