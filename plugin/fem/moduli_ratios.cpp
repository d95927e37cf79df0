#include "synovia/fem/moduli_ratios.hpp"
#include "synovia/general/reduce.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

ModuliRatios FindModuliRatios(ParMesh &mesh, const MaterialTable &materials)
{
   ModuliRatios ratios;
   DenseMatrix stiffness;
   for (int i = 0; i < mesh.GetNE(); i++)
   {
      const Material &material = materials.Get(mesh.GetAttribute(i));
      if (material.IsRigid())
      {
         continue;
      }
      const SolidLaw &solid = *material.solid;
      ElementTransformation &trans = *mesh.GetElementTransformation(i);
      const IntegrationPoint &center =
         Geometries.GetCenter(trans.GetGeometryType());
      trans.SetIntPoint(&center);
      solid.GetStiffness(trans, center, stiffness);
      const real_t stiffest =
         std::max({stiffness(0, 0), stiffness(1, 1), stiffness(2, 2)});
      const real_t softest = solid.AggregateModulus();
      ratios.anisotropy = std::max(ratios.anisotropy, stiffest / softest);
      ratios.incompressibility =
         std::max(ratios.incompressibility, softest / solid.ShearModulus());
   }
   const MPI_Comm comm = mesh.GetComm();
   ratios.anisotropy = MaxOverRanks(ratios.anisotropy, comm);
   ratios.incompressibility = MaxOverRanks(ratios.incompressibility, comm);
   return ratios;
}

} // namespace synovia
