#include "synovia/fem/body_element.hpp"
#include "synovia/fem/quadrature_order.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
// All gradients by reference coordinates, dofs x (3 x points).
DenseMatrix Slopes(const FiniteElement &element, const IntegrationRule &rule)
{
   const int dofs = element.GetDof();
   DenseMatrix slopes(dofs, 3 * rule.GetNPoints());
   for (int q = 0; q < rule.GetNPoints(); q++)
   {
      DenseMatrix at_point(slopes.GetColumn(3 * q), dofs, 3);
      element.CalcDShape(rule.IntPoint(q), at_point);
   }
   return slopes;
}

DenseMatrix Shapes(const FiniteElement &element, const IntegrationRule &rule)
{
   DenseMatrix shapes(element.GetDof(), rule.GetNPoints());
   for (int q = 0; q < rule.GetNPoints(); q++)
   {
      Vector at_point(shapes.GetColumn(q), element.GetDof());
      element.CalcShape(rule.IntPoint(q), at_point);
   }
   return shapes;
}
} // namespace

BodyElement::BodyElement(BiphasicSpaces &spaces_) : spaces(spaces_)
{
   begins.push_back(0);
   for (int e = 0; e < spaces.GetMesh().GetNE(); e++)
   {
      const Geometry::Type shape = spaces.GetMesh().GetElementGeometry(e);
      if (tables_of.count(shape) == 0)
      {
         tables_of.emplace(shape, Tabulate(e));
      }
      begins.push_back(begins.back() + tables_of.at(shape).rule->GetNPoints());
   }
   KeepGeometry();
}

BodyElement::Tables BodyElement::Tabulate(int element)
{
   const FiniteElement &fe = *spaces.Displacement().GetFE(element);
   const FiniteElement &p_fe = *spaces.Pressure().GetFE(element);
   spaces.GetMesh().GetElementTransformation(element, &trans);
   // Exact for products of gradients and for the pressure's mass matrix, on
   // straight elements.
   const int order = 2 * std::max(fe.GetOrder() - 1, 1) + trans.OrderW();
   const IntegrationRule &rule =
      IntRules.Get(fe.GetGeomType(), QuadratureOrder(fe, trans, order));
   return {&rule, Slopes(fe, rule), Shapes(p_fe, rule), Slopes(p_fe, rule)};
}

void BodyElement::KeepGeometry()
{
   weights.reserve(AllPoints());
   inverse_jacobians.reserve(9 * static_cast<size_t>(AllPoints()));
   for (int e = 0; e < spaces.GetMesh().GetNE(); e++)
   {
      spaces.GetMesh().GetElementTransformation(e, &trans);
      const IntegrationRule &rule = *tables_of.at(trans.GetGeometryType()).rule;
      for (int q = 0; q < rule.GetNPoints(); q++)
      {
         trans.SetIntPoint(&rule.IntPoint(q));
         weights.push_back(rule.IntPoint(q).weight * trans.Weight());
         const DenseMatrix &inverse = trans.InverseJacobian();
         for (int k = 0; k < 9; k++)
         {
            inverse_jacobians.push_back(inverse(k / 3, k % 3));
         }
      }
   }
}

void BodyElement::Set(int element, const Vector &u, const Vector &p)
{
   current = element;
   spaces.GetMesh().GetElementTransformation(element, &trans);
   tables = &tables_of.at(trans.GetGeometryType());
   spaces.Displacement().GetElementVDofs(element, u_dofs);
   spaces.Pressure().GetElementDofs(element, p_dofs);
   u.GetSubVector(u_dofs, u_values);
   p.GetSubVector(p_dofs, p_values);
   ToBody(tables->slopes, gradients);
   ToBody(tables->p_slopes, p_gradients);
   displacement_gradients.SetSize(3, gradients.Width());
   const DenseMatrix values(u_values.GetData(), gradients.Height(), 3);
   MultAtB(values, gradients, displacement_gradients);
   pressures.SetSize(Points());
   tables->p_shapes.MultTranspose(p_values, pressures);
   pressure_gradients.SetSize(3 * Points());
   p_gradients.MultTranspose(p_values, pressure_gradients);
}

void BodyElement::ToBody(const DenseMatrix &slopes, DenseMatrix &to) const
{
   const int dofs = slopes.Height();
   to.SetSize(dofs, slopes.Width());
   for (int q = 0; q < Points(); q++)
   {
      const real_t *const along = slopes.GetColumn(3 * q);
      const real_t *const inverse =
         inverse_jacobians.data() + 9 * (begins[current] + size_t(q));
      for (int b = 0; b < 3; b++)
      {
         real_t *const gradient = to.GetColumn(3 * q + b);
         for (int i = 0; i < dofs; i++)
         {
            gradient[i] = along[i] * inverse[b] +
                          along[dofs + i] * inverse[3 + b] +
                          along[2 * dofs + i] * inverse[6 + b];
         }
      }
   }
}

MaterialPoint BodyElement::Point(int point)
{
   const IntegrationPoint &ip = tables->rule->IntPoint(point);
   trans.SetIntPoint(&ip);
   return {trans, ip};
}

Vector BodyElement::Position(int point)
{
   Vector position(3);
   trans.Transform(tables->rule->IntPoint(point), position);
   return position;
}

Tensor3<> BodyElement::DeformationGradient(int point) const
{
   Tensor3<> F = IdentityTensor();
   for (int a = 0; a < 3; a++)
   {
      for (int b = 0; b < 3; b++)
      {
         F[a][b] += displacement_gradients(a, 3 * point + b);
      }
   }
   return F;
}

Vector3<> BodyElement::PressureGradient(int point) const
{
   return {pressure_gradients[3 * point], pressure_gradients[3 * point + 1],
           pressure_gradients[3 * point + 2]};
}

} // namespace synovia
