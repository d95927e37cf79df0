#include "synovia/fem/moduli_ratios.hpp"
#include "synovia/general/point3.hpp"
#include "synovia/general/reduce.hpp"

#include <algorithm>
#include <limits>

namespace synovia
{

using namespace mfem;

namespace
{
// @a along is the stiffness of a stretch along a direction (1 or 0 or -1 times
// each axis), times its length to the fourth.
template <typename Stiffness>
real_t LargestOverSmallest(const Stiffness &along)
{
   real_t largest = 0.0;
   real_t smallest = std::numeric_limits<real_t>::infinity();
   // Those of a cube's edges, and of the diagonals of its faces and itself.
   for (int code = 14; code < 27; code++)
   {
      const Point3 direction{
         {code / 9 - 1.0, code / 3 % 3 - 1.0, code % 3 - 1.0}};
      const real_t square = Dot(direction, direction);
      const real_t stiffness = along(direction) / (square * square);
      largest = std::max(largest, stiffness);
      smallest = std::min(smallest, stiffness);
   }
   return smallest > 0.0 ? largest / smallest
                         : std::numeric_limits<real_t>::infinity();
}

real_t AnisotropyAsMeshed(const SolidLaw &solid, const MaterialPoint &point)
{
   DenseMatrix stiffness;
   solid.GetStiffness(point.trans, point.ip, stiffness);
   return LargestOverSmallest(
      [&stiffness](const Point3 &n)
      {
         const Vector strain({n[0] * n[0], n[1] * n[1], n[2] * n[2],
                              2.0 * n[0] * n[1], 2.0 * n[1] * n[2],
                              2.0 * n[0] * n[2]});
         return stiffness.InnerProduct(strain, strain);
      });
}

real_t AnisotropyStretched(const SolidLaw &solid, const MaterialPoint &point)
{
   constexpr real_t stretch = 1.05;
   Tensor3<> F{};
   for (int i = 0; i < 3; i++)
   {
      F[i][i] = stretch;
   }
   Tensor3<> stress;
   Tangent3 tangent;
   if (!solid.IsObjective() || !solid.GetStress(point, F, stress, &tangent))
   {
      return 0.0;
   }
   return LargestOverSmallest(
      [&tangent](const Point3 &n)
      {
         real_t sum = 0.0;
         for (int i = 0; i < 9; i++)
         {
            for (int j = 0; j < 9; j++)
            {
               sum += tangent[i][j] * n[i / 3] * n[i % 3] * n[j / 3] * n[j % 3];
            }
         }
         return sum;
      });
}

// Of one element that is not rigid.
ModuliRatios RatiosOf(ParMesh &mesh, int element, const SolidLaw &solid)
{
   ElementTransformation &trans = *mesh.GetElementTransformation(element);
   const IntegrationPoint &center =
      Geometries.GetCenter(trans.GetGeometryType());
   trans.SetIntPoint(&center);
   const MaterialPoint point{trans, center};
   ModuliRatios ratios;
   ratios.anisotropy = std::max(AnisotropyAsMeshed(solid, point),
                                AnisotropyStretched(solid, point));
   ratios.incompressibility = solid.AggregateModulus() / solid.ShearModulus();
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
