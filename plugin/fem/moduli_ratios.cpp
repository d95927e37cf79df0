#include "synovia/fem/moduli_ratios.hpp"
#include "synovia/general/reduce.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

namespace
{
real_t LargestStiffness(const SolidLaw &solid, const MaterialPoint &point)
{
   constexpr real_t stretch = 1.05;
   DenseMatrix stiffness;
   solid.GetStiffness(point.trans, point.ip, stiffness);
   real_t largest =
      std::max({stiffness(0, 0), stiffness(1, 1), stiffness(2, 2)});
   Tensor3<> F{};
   Tensor3<> stress;
   Tangent3 tangent;
   for (int i = 0; i < 3; i++)
   {
      F[i][i] = stretch;
   }
   if (solid.IsObjective() && solid.GetStress(point, F, stress, &tangent))
   {
      largest =
         std::max({largest, tangent[0][0], tangent[4][4], tangent[8][8]});
   }
   return largest;
}

// Of one element that is not rigid.
ModuliRatios RatiosOf(ParMesh &mesh, int element, const SolidLaw &solid)
{
   ElementTransformation &trans = *mesh.GetElementTransformation(element);
   const IntegrationPoint &center =
      Geometries.GetCenter(trans.GetGeometryType());
   trans.SetIntPoint(&center);
   const real_t softest = solid.AggregateModulus();
   ModuliRatios ratios;
   ratios.anisotropy = LargestStiffness(solid, {trans, center}) / softest;
   ratios.incompressibility = softest / solid.ShearModulus();
   return ratios;
}
} // namespace

ModuliRatios FindModuliRatios(ParMesh &mesh, const MaterialTable &materials)
{
   ModuliRatios largest;
   for (int i = 0; i < mesh.GetNE(); i++)
   {
      const Material &material = materials.Get(mesh.GetAttribute(i));
      if (material.IsRigid())
      {
         continue;
      }
      const ModuliRatios here = RatiosOf(mesh, i, *material.solid);
      largest.anisotropy = std::max(largest.anisotropy, here.anisotropy);
      largest.incompressibility =
         std::max(largest.incompressibility, here.incompressibility);
   }
   const MPI_Comm comm = mesh.GetComm();
   largest.anisotropy = MaxOverRanks(largest.anisotropy, comm);
   largest.incompressibility = MaxOverRanks(largest.incompressibility, comm);
   return largest;
}

Vector FindAnisotropy(BiphasicSpaces &spaces, const MaterialTable &materials)
{
   ParFiniteElementSpace &space = spaces.Displacement();
   ParMesh &mesh = spaces.GetMesh();
   Array<real_t> local(space.GetVSize());
   local = 0.0;
   Array<int> dofs;
   for (int i = 0; i < mesh.GetNE(); i++)
   {
      const Material &material = materials.Get(mesh.GetAttribute(i));
      if (material.IsRigid())
      {
         continue;
      }
      const real_t here = RatiosOf(mesh, i, *material.solid).anisotropy;
      space.GetElementVDofs(i, dofs);
      for (const int dof : dofs)
      {
         local[dof] = std::max(local[dof], here);
      }
   }
   space.GroupComm().Reduce<real_t>(local.GetData(),
                                    GroupCommunicator::Max<real_t>);
   Vector anisotropy(space.GetTrueVSize());
   for (int dof = 0; dof < local.Size(); dof++)
   {
      const int true_dof = space.GetLocalTDofNumber(dof);
      if (true_dof >= 0)
      {
         anisotropy[true_dof] = local[dof];
      }
   }
   return anisotropy;
}

} // namespace synovia
