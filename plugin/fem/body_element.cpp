#include "synovia/fem/body_element.hpp"
#include "synovia/fem/quadrature_order.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
// All gradients by reference coordinates, dofs x (3 x points).
DenseMatrix TabulatedSlopes(const FiniteElement &element,
                            const IntegrationRule &rule)
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

DenseMatrix TabulatedShapes(const FiniteElement &element,
                            const IntegrationRule &rule)
{
   DenseMatrix shapes(element.GetDof(), rule.GetNPoints());
   for (int q = 0; q < rule.GetNPoints(); q++)
   {
      Vector at_point(shapes.GetColumn(q), element.GetDof());
      element.CalcShape(rule.IntPoint(q), at_point);
   }
   return shapes;
}

const IntegrationRule &Corners(Geometry::Type shape)
{
   static std::map<Geometry::Type, IntegrationRule> rules;
   const auto [place, is_new] = rules.try_emplace(shape);
   if (is_new)
   {
      place->second = *Geometries.GetVertices(shape);
      for (IntegrationPoint &corner : place->second)
      {
         corner.weight = Geometry::Volume[shape] / place->second.Size();
      }
   }
   return place->second;
}

// That of the geometry of elements with straight sides.
const FiniteElement *StraightElement(Geometry::Type shape)
{
   static const H1_FECollection corners(1, 3);
   return corners.FiniteElementForGeometry(shape);
}
} // namespace

BodyElement::BodyElement(BiphasicSpaces &spaces_, ElementPoints points)
   : spaces(spaces_)
{
   begins.push_back(0);
   for (int e = 0; e < spaces.GetMesh().GetNE(); e++)
   {
      const Geometry::Type shape = spaces.GetMesh().GetElementGeometry(e);
      if (tables_of.count(shape) == 0)
      {
         tables_of.emplace(shape, Tabulate(e, points));
      }
      begins.push_back(begins.back() + tables_of.at(shape).rule->GetNPoints());
   }
   KeepGeometry();
}

BodyElement::Tables BodyElement::Tabulate(int element, ElementPoints points)
{
   const FiniteElement &fe = *spaces.Displacement().GetFE(element);
   const FiniteElement &p_fe = *spaces.Pressure().GetFE(element);
   spaces.GetMesh().GetElementTransformation(element, &trans);
   IsoparametricTransformation straight;
   straight.SetFE(StraightElement(fe.GetGeomType()));
   const IsoparametricTransformation &shape =
      points == ElementPoints::straight ? straight : trans;
   // Exact for products of gradients and for the pressure's mass matrix, on
   // straight elements.
   const int order = 2 * std::max(fe.GetOrder() - 1, 1) + shape.OrderW();
   const IntegrationRule &rule =
      points == ElementPoints::corners
         ? Corners(fe.GetGeomType())
         : IntRules.Get(fe.GetGeomType(), QuadratureOrder(fe, shape, order));
   return {&rule, TabulatedSlopes(fe, rule), TabulatedShapes(p_fe, rule),
           TabulatedSlopes(p_fe, rule)};
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
   gradients_known = false;
   p_gradients_known = false;
   const DenseMatrix values(u_values.GetData(), tables->slopes.Height(), 3);
   displacement_slopes.SetSize(tables->slopes.Width(), 3);
   MultAtB(tables->slopes, values, displacement_slopes);
   pressures.SetSize(Points());
   tables->p_shapes.MultTranspose(p_values, pressures);
   pressure_slopes.SetSize(3 * Points());
   tables->p_slopes.MultTranspose(p_values, pressure_slopes);
}

const DenseMatrix &BodyElement::Gradients()
{
   if (!gradients_known)
   {
      ToBody(tables->slopes, gradients);
      gradients_known = true;
   }
   return gradients;
}

const DenseMatrix &BodyElement::PressureGradients()
{
   if (!p_gradients_known)
   {
      ToBody(tables->p_slopes, p_gradients);
      p_gradients_known = true;
   }
   return p_gradients;
}

void BodyElement::ToBody(const DenseMatrix &slopes, DenseMatrix &to) const
{
   const int dofs = slopes.Height();
   to.SetSize(dofs, slopes.Width());
   for (int q = 0; q < Points(); q++)
   {
      const real_t *const along = slopes.GetColumn(3 * q);
      const real_t *const inverse = InverseJacobian(q);
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
      F[a] += ToBody(point, displacement_slopes.GetColumn(a) + 3 * point);
   }
   return F;
}

Vector3<> BodyElement::ToBody(int point, const real_t *slope) const
{
   const real_t *const inverse = InverseJacobian(point);
   Vector3<> gradient;
   for (int b = 0; b < 3; b++)
   {
      gradient[b] = slope[0] * inverse[b] + slope[1] * inverse[3 + b] +
                    slope[2] * inverse[6 + b];
   }
   return gradient;
}

Vector3<> BodyElement::ToReference(int point, const Vector3<> &vector) const
{
   const real_t *const inverse = InverseJacobian(point);
   Vector3<> reference;
   for (int c = 0; c < 3; c++)
   {
      reference[c] = inverse[3 * c] * vector[0] +
                     inverse[3 * c + 1] * vector[1] +
                     inverse[3 * c + 2] * vector[2];
   }
   return reference;
}

} // namespace synovia
