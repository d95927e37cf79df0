#include "synovia/fem/smooth_stabilization.hpp"
#include "synovia/fem/pressure_projection_integrator.hpp"

#include <cmath>
#include <limits>

namespace synovia
{

using namespace mfem;

SmoothStabilization::SmoothStabilization(BiphasicSpaces &spaces,
                                         const MaterialTable &materials)
   : space(spaces.Pressure())
{
   MFEM_VERIFY(space.GetMaxElementOrder() == 1,
               "a smooth part is defined for order 1");
   PressureProjectionIntegrator integrator(materials, spaces.Stabilization());
   Vector x(3);
   for (int e = 0; e < space.GetNE(); e++)
   {
      if (!materials.Get(space.GetParMesh()->GetAttribute(e)).HasFluid())
      {
         continue;
      }
      elements.emplace_back();
      Element &element = elements.back();
      space.GetElementDofs(e, element.dofs);
      const FiniteElement &fe = *space.GetFE(e);
      ElementTransformation &trans = *space.GetElementTransformation(e);
      integrator.AssembleElementMatrix(fe, trans, element.stabilization);
      element.nodes.SetSize(fe.GetDof(), 3);
      for (int i = 0; i < fe.GetDof(); i++)
      {
         trans.Transform(fe.GetNodes().IntPoint(i), x);
         element.nodes.SetRow(i, x);
      }
      trans.SetIntPoint(&Geometries.GetCenter(fe.GetGeomType()));
      element.gradients.SetSize(fe.GetDof(), 3);
      fe.CalcPhysDShape(trans, element.gradients);
   }
}

Vector SmoothStabilization::LeastAround(const std::vector<Point3> &gradients,
                                        int component) const
{
   constexpr real_t infinity = std::numeric_limits<real_t>::infinity();
   Vector lowest(space.GetVSize());
   Vector highest(space.GetVSize());
   lowest = infinity;
   highest = -infinity;
   for (size_t e = 0; e < elements.size(); e++)
   {
      for (const int dof : elements[e].dofs)
      {
         lowest[dof] = std::min(lowest[dof], gradients[e][component]);
         highest[dof] = std::max(highest[dof], gradients[e][component]);
      }
   }
   GroupCommunicator &comm = space.GroupComm();
   comm.Reduce<real_t>(lowest.GetData(), GroupCommunicator::Min<real_t>);
   comm.Bcast<real_t>(lowest.GetData());
   comm.Reduce<real_t>(highest.GetData(), GroupCommunicator::Max<real_t>);
   comm.Bcast<real_t>(highest.GetData());
   for (int i = 0; i < lowest.Size(); i++)
   {
      // No element of the vertices where there is no fluid is asked for.
      lowest[i] = lowest[i] > 0.0 ? lowest[i] : std::min(highest[i], 0.0);
   }
   return lowest;
}

void SmoothStabilization::Mult(const Vector &p, Vector &y) const
{
   const Operator &prolongation = *space.GetProlongationMatrix();
   Vector values(space.GetVSize());
   prolongation.Mult(p, values);
   values.HostRead();
   std::vector<Point3> gradients(elements.size());
   Vector at_dofs;
   for (size_t e = 0; e < elements.size(); e++)
   {
      values.GetSubVector(elements[e].dofs, at_dofs);
      elements[e].gradients.MultTranspose(at_dofs.GetData(),
                                          gradients[e].data());
   }
   std::array<Vector, 3> least;
   for (int d = 0; d < 3; d++)
   {
      least[d] = LeastAround(gradients, d);
   }

   Vector local(space.GetVSize());
   local = 0.0;
   Vector share;
   for (size_t e = 0; e < elements.size(); e++)
   {
      const Element &element = elements[e];
      // Components of different signs at two vertices are zero at one of them.
      Vector smooth(3);
      for (int d = 0; d < 3; d++)
      {
         smooth[d] = gradients[e][d];
         for (const int dof : element.dofs)
         {
            if (std::abs(least[d][dof]) < std::abs(smooth[d]))
            {
               smooth[d] = least[d][dof];
            }
         }
      }
      at_dofs.SetSize(element.dofs.Size());
      element.nodes.Mult(smooth, at_dofs);
      share.SetSize(element.dofs.Size());
      element.stabilization.Mult(at_dofs, share);
      local.AddElementVector(element.dofs, share);
   }
   y.SetSize(space.GetTrueVSize());
   prolongation.MultTranspose(local, y);
   y.HostReadWrite();
}

} // namespace synovia
