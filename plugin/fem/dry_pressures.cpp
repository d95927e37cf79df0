#include "synovia/fem/dry_pressures.hpp"

namespace synovia
{

using namespace mfem;

Array<int> FindDryPressures(BiphasicSpaces &spaces,
                            const MaterialTable &materials)
{
   ParFiniteElementSpace &space = spaces.Pressure();
   Array<int> wet(space.GetVSize());
   wet = 0;
   Array<int> dofs;
   for (int e = 0; e < space.GetNE(); e++)
   {
      if (materials.Get(space.GetParMesh()->GetAttribute(e)).HasFluid())
      {
         space.GetElementDofs(e, dofs);
         for (const int dof : dofs)
         {
            wet[dof] = 1;
         }
      }
   }
   space.GroupComm().Reduce<int>(wet, GroupCommunicator::Max);
   Array<int> dry;
   for (int dof = 0; dof < wet.Size(); dof++)
   {
      const int true_dof = space.GetLocalTDofNumber(dof);
      if (true_dof >= 0 && !wet[dof])
      {
         dry.Append(true_dof);
      }
   }
   dry.Sort();
   return dry;
}

} // namespace synovia
