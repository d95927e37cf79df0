#include "synovia/fem/biphasic_spaces.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/text.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

namespace
{
int CheckedOrder(int order)
{
   if (order < 1)
   {
      throw Error("the order of the displacement is " + std::to_string(order) +
                  "; it must be 1 (stabilized) or more");
   }
   return order;
}

ParMesh &CheckedMesh(ParMesh &mesh)
{
   if (mesh.Nonconforming())
   {
      throw Error("the mesh is one that may have hanging nodes, which bodies "
                  "can't have: refine all of its elements, or remesh it");
   }
   return mesh;
}

real_t CheckedStabilization(real_t factor)
{
   if (!(factor >= 0.0 && factor <= 1.0))
   {
      throw Error("the stabilization is " + ToText(factor) +
                  "; it must be from 0 to 1");
   }
   return factor;
}
} // namespace

BiphasicSpaces::BiphasicSpaces(ParMesh &mesh, int order_, real_t stabilization_)
   : order(CheckedOrder(order_)),
     stabilization(CheckedStabilization(stabilization_)),
     displacement_elements(order, 3),
     pressure_elements(std::max(1, order - 1), 3), multiplier_elements(1, 3)
{
   displacement = std::make_unique<ParFiniteElementSpace>(
      &CheckedMesh(mesh), &displacement_elements, 3, Ordering::byVDIM);
   pressure =
      std::make_unique<ParFiniteElementSpace>(&mesh, &pressure_elements);
   multiplier = pressure.get();
   if (pressure_elements.GetOrder() > 1)
   {
      own_multiplier =
         std::make_unique<ParFiniteElementSpace>(&mesh, &multiplier_elements);
      multiplier = own_multiplier.get();
   }
   offsets.SetSize(3);
   offsets[0] = 0;
   offsets[1] = displacement->GetTrueVSize();
   offsets[2] = offsets[1] + pressure->GetTrueVSize();
}

Array<int> BiphasicSpaces::VerticesAmong(const Array<int> &pressure_dofs) const
{
   Array<int> among(pressure->GetTrueVSize());
   among = 0;
   for (const int dof : pressure_dofs)
   {
      among[dof] = 1;
   }
   Array<int> vertices;
   Array<int> dofs;
   for (int v = 0; v < pressure->GetMesh()->GetNV(); v++)
   {
      pressure->GetVertexDofs(v, dofs);
      const int dof = pressure->GetLocalTDofNumber(dofs[0]);
      if (dof >= 0 && among[dof])
      {
         multiplier->GetVertexDofs(v, dofs);
         vertices.Append(multiplier->GetLocalTDofNumber(dofs[0]));
      }
   }
   vertices.Sort();
   return vertices;
}

} // namespace synovia
