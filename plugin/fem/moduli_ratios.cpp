#include "synovia/fem/moduli_ratios.hpp"
#include "synovia/general/point3.hpp"
#include "synovia/general/reduce.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace synovia
{

using namespace mfem;

namespace
{
// The edges of a cube and the diagonals of its faces and itself.
constexpr std::array<Point3, 13> directions{{{{1.0, 0.0, 0.0}},
                                             {{0.0, 1.0, 0.0}},
                                             {{0.0, 0.0, 1.0}},
                                             {{1.0, 1.0, 0.0}},
                                             {{1.0, -1.0, 0.0}},
                                             {{0.0, 1.0, 1.0}},
                                             {{0.0, 1.0, -1.0}},
                                             {{1.0, 0.0, 1.0}},
                                             {{1.0, 0.0, -1.0}},
                                             {{1.0, 1.0, 1.0}},
                                             {{1.0, 1.0, -1.0}},
                                             {{1.0, -1.0, 1.0}},
                                             {{1.0, -1.0, -1.0}}}};

// Of a further stretch along @a n: (n n) : A : (n n) / |n|^4.
real_t StiffnessAlong(const Tangent3 &tangent, const Point3 &n)
{
   real_t sum = 0.0;
   for (int i = 0; i < 9; i++)
   {
      for (int j = 0; j < 9; j++)
      {
         sum += tangent[i][j] * n[i / 3] * n[i % 3] * n[j / 3] * n[j % 3];
      }
   }
   const real_t square = Dot(n, n);
   return sum / (square * square);
}

// The largest over the smallest stiffness at @a stretch along all directions; 0
// where the law has no value.
real_t AnisotropyAt(real_t stretch, const SolidLaw &solid,
                    const MaterialPoint &point)
{
   Tensor3<> F{};
   for (int i = 0; i < 3; i++)
   {
      F[i][i] = stretch;
   }
   Tensor3<> stress;
   Tangent3 tangent;
   if (!solid.GetStress(point, F, stress, &tangent))
   {
      return 0.0;
   }
   real_t largest = 0.0;
   real_t smallest = std::numeric_limits<real_t>::infinity();
   for (const Point3 &direction : directions)
   {
      const real_t stiffness = StiffnessAlong(tangent, direction);
      largest = std::max(largest, stiffness);
      smallest = std::min(smallest, stiffness);
   }
   return smallest > 0.0 ? largest / smallest
                         : std::numeric_limits<real_t>::infinity();
}

real_t Anisotropy(const SolidLaw &solid, const MaterialPoint &point)
{
   const real_t as_meshed = AnisotropyAt(1.0, solid, point);
   return solid.IsObjective()
             ? std::max(as_meshed, AnisotropyAt(1.05, solid, point))
             : as_meshed;
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
   ratios.anisotropy = Anisotropy(solid, point);
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
