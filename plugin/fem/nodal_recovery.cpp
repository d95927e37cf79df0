#include "synovia/fem/nodal_recovery.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
/// Adds up what the ranks have for each shared degree of freedom.
void SumSharedDofs(const ParFiniteElementSpace &space, Vector &dofs)
{
   const Operator &prolongation = *space.GetProlongationMatrix();
   Vector true_dofs(space.GetTrueVSize());
   prolongation.MultTranspose(dofs, true_dofs);
   prolongation.Mult(true_dofs, dofs);
   dofs.HostReadWrite();
}

// Least squares on the reference element: the fit's values at the nodes are
// N (sum_q w phi phi^T)^-1 (w phi), and exact for polynomials of its order.
DenseMatrix FitToNodes(const FiniteElement &element, const FiniteElement &fit,
                       const IntegrationRule &rule)
{
   const IntegrationRule &nodes = element.GetNodes();
   Vector shape(fit.GetDof());
   DenseMatrix moments(fit.GetDof(), rule.GetNPoints());
   DenseMatrix mass(fit.GetDof());
   mass = 0.0;
   for (int q = 0; q < rule.GetNPoints(); q++)
   {
      fit.CalcShape(rule.IntPoint(q), shape);
      AddMult_a_VVt(rule.IntPoint(q).weight, shape, mass);
      shape *= rule.IntPoint(q).weight;
      moments.SetCol(q, shape);
   }
   DenseMatrix at_nodes(nodes.GetNPoints(), fit.GetDof());
   for (int i = 0; i < nodes.GetNPoints(); i++)
   {
      fit.CalcShape(nodes.IntPoint(i), shape);
      at_nodes.SetRow(i, shape);
   }
   DenseMatrixInverse(mass).Mult(DenseMatrix(moments), moments);
   DenseMatrix to_nodes(nodes.GetNPoints(), rule.GetNPoints());
   Mult(at_nodes, moments, to_nodes);
   return to_nodes;
}
} // namespace

NodalRecovery::NodalRecovery(ParFiniteElementSpace &displacement,
                             int components)
   : space(displacement.GetParMesh(), displacement.FEColl(), components),
     elements_of_dof(space.GetVSize())
{
   elements_of_dof = 0.0;
   for (int e = 0; e < space.GetNE(); e++)
   {
      space.GetElementVDofs(e, dofs);
      for (const int dof : dofs)
      {
         elements_of_dof(dof) += 1.0;
      }
   }
   SumSharedDofs(space, elements_of_dof);
}

const NodalRecovery::Extrapolation &NodalRecovery::ExtrapolationOf(int e)
{
   const FiniteElement &element = *space.GetFE(e);
   const Geometry::Type geometry = element.GetGeomType();
   const auto known = extrapolations.find(geometry);
   if (known != extrapolations.end())
   {
      return known->second;
   }
   const int order = element.GetOrder() - 1;
   const L2_FECollection polynomials(order, 3);
   const FiniteElement &fit = *polynomials.FiniteElementForGeometry(geometry);
   const IntegrationRule &rule = IntRules.Get(geometry, 2 * order);
   return extrapolations
      .emplace(geometry, Extrapolation{&rule, FitToNodes(element, fit, rule)})
      .first->second;
}

void NodalRecovery::ToNodes(int element, const DenseMatrix &at_points,
                            DenseMatrix &at_nodes)
{
   const DenseMatrix &to_nodes = ExtrapolationOf(element).to_nodes;
   at_nodes.SetSize(to_nodes.Height(), at_points.Width());
   Mult(to_nodes, at_points, at_nodes);
}

void NodalRecovery::Add(int element, const DenseMatrix &at_nodes,
                        ParGridFunction &field)
{
   // An element's dofs go component by component, as the matrix does.
   const Vector values(at_nodes.GetData(),
                       at_nodes.Height() * at_nodes.Width());
   space.GetElementVDofs(element, dofs);
   field.AddElementVector(dofs, values);
}

void NodalRecovery::Average(ParGridFunction &field) const
{
   SumSharedDofs(space, field);
   for (int i = 0; i < field.Size(); i++)
   {
      field(i) /= elements_of_dof(i);
   }
}

} // namespace synovia
