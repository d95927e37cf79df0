#include "synovia/fem/displacement_gradient.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

namespace
{
IntegrationRule GradientPoints(Geometry::Type geometry, int order)
{
   const bool complete = geometry == Geometry::TETRAHEDRON;
   const H1_FECollection polynomials(complete ? std::max(1, order - 1) : order,
                                     3);
   const IntegrationRule &nodes =
      polynomials.FiniteElementForGeometry(geometry)->GetNodes();
   IntegrationRule points;
   for (int i = 0; i < nodes.GetNPoints(); i++)
   {
      if (geometry != Geometry::PYRAMID || nodes.IntPoint(i).z < 1.0 - 1e-6)
      {
         points.Append(nodes.IntPoint(i));
      }
   }
   return points;
}
} // namespace

DisplacementGradient::DisplacementGradient(ParMesh &mesh_,
                                           const ParGridFunction &displacement_)
   : mesh(mesh_), displacement(displacement_),
     element_dofs(displacement.ParFESpace()->GetElementToDofTable())
{
   const ParFiniteElementSpace &space = *displacement.ParFESpace();
   MFEM_VERIFY(space.GetOrdering() == Ordering::byVDIM,
               "components of a node should follow each other");
   for (int e = 0; e < mesh.GetNE(); e++)
   {
      const Geometry::Type geometry = mesh.GetElementGeometry(e);
      if (shapes.count(geometry) == 0)
      {
         shapes.emplace(geometry, Tabulate(*space.GetFE(e)));
      }
   }
   KeepJacobians();
}

DisplacementGradient::Shapes
DisplacementGradient::Tabulate(const FiniteElement &element)
{
   const IntegrationRule rule =
      GradientPoints(element.GetGeomType(), element.GetOrder());
   const int points = rule.GetNPoints();
   const int nodes = element.GetDof();
   Shapes made{rule, std::vector<real_t>(3 * points * nodes)};
   DenseMatrix at_point(nodes, 3);
   for (int q = 0; q < points; q++)
   {
      element.CalcDShape(rule.IntPoint(q), at_point);
      for (int i = 0; i < nodes; i++)
      {
         for (int d = 0; d < 3; d++)
         {
            made.derivatives[(3 * i + d) * points + q] = at_point(i, d);
         }
      }
   }
   return made;
}

void DisplacementGradient::KeepJacobians()
{
   for (int e = 0; e < mesh.GetNE(); e++)
   {
      ElementTransformation &map = *mesh.GetElementTransformation(e);
      const IntegrationRule &rule = shapes.at(map.GetGeometryType()).rule;
      const int points = rule.GetNPoints();
      const size_t begin = inverse_jacobians.size();
      begins.push_back(begin);
      inverse_jacobians.resize(begin + 9 * points);
      for (int q = 0; q < points; q++)
      {
         map.SetIntPoint(&rule.IntPoint(q));
         const DenseMatrix &inverse = map.InverseJacobian();
         for (int c = 0; c < 9; c++)
         {
            inverse_jacobians[begin + c * points + q] = inverse(c / 3, c % 3);
         }
      }
   }
}

void DisplacementGradient::SetElement(int element)
{
   current_element = element;
   current = &shapes.at(mesh.GetElementGeometry(element));
   const int points = Points();
   reference.assign(9 * points, 0.0);
   gradients.assign(9 * points, 0.0);
   const real_t *const u = displacement.HostRead();
   const int *const dofs = element_dofs.GetRow(element);
   for (int i = 0; i < element_dofs.RowSize(element); i++)
   {
      const real_t *const along = current->derivatives.data() + 3 * points * i;
      for (int c = 0; c < 3; c++)
      {
         const real_t value = u[3 * dofs[i] + c];
         real_t *const sum = reference.data() + 3 * points * c;
         for (int k = 0; k < 3 * points; k++)
         {
            sum[k] += value * along[k];
         }
      }
   }
   for (int c = 0; c < 3; c++)
   {
      for (int d = 0; d < 3; d++)
      {
         const real_t *const from = reference.data() + (3 * c + d) * points;
         const real_t *const inverse =
            inverse_jacobians.data() + begins[element] + 3 * d * points;
         real_t *const to = gradients.data() + 3 * c * points;
         for (int j = 0; j < 3; j++)
         {
            for (int q = 0; q < points; q++)
            {
               to[j * points + q] += from[q] * inverse[j * points + q];
            }
         }
      }
   }
}

DenseMatrix DisplacementGradient::At(int point) const
{
   DenseMatrix gradient(3);
   for (int i = 0; i < 3; i++)
   {
      for (int j = 0; j < 3; j++)
      {
         gradient(i, j) = Component(i, j)[point];
      }
   }
   return gradient;
}

DenseMatrix DisplacementGradient::Places()
{
   DenseMatrix places;
   mesh.GetElementTransformation(current_element)
      ->Transform(current->rule, places);
   return places;
}

} // namespace synovia
