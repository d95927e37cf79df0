#include "synovia/fem/body_element.hpp"
#include "synovia/fem/quadrature_order.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
// The gradients of all shape functions at a point, from a table.
void GetReferenceGradients(const DofToQuad &maps, int point, int points,
                           DenseMatrix &gradients)
{
   const int dofs = gradients.Height();
   for (int d = 0; d < 3; d++)
   {
      for (int i = 0; i < dofs; i++)
      {
         gradients(i, d) = maps.G[point + points * (d + 3 * i)];
      }
   }
}
} // namespace

BodyElement::BodyElement(BiphasicSpaces &spaces_) : spaces(spaces_) {}

const IntegrationRule &BodyElement::Rule(int element)
{
   const FiniteElement &fe = *spaces.Displacement().GetFE(element);
   const ElementTransformation &mapping =
      *spaces.GetMesh().GetElementTransformation(element);
   // Exact for products of gradients and for the pressure's mass matrix, on
   // straight elements.
   const int order = 2 * std::max(fe.GetOrder() - 1, 1) + mapping.OrderW();
   return IntRules.Get(fe.GetGeomType(), QuadratureOrder(fe, mapping, order));
}

int BodyElement::AllPoints()
{
   int points = 0;
   for (int e = 0; e < spaces.GetMesh().GetNE(); e++)
   {
      points += Rule(e).GetNPoints();
   }
   return points;
}

void BodyElement::Set(int element, const Vector &u, const Vector &p_field)
{
   u_element = spaces.Displacement().GetFE(element);
   p_element = spaces.Pressure().GetFE(element);
   rule = &Rule(element);
   trans = spaces.GetMesh().GetElementTransformation(element);
   u_maps = &u_element->GetDofToQuad(*rule, DofToQuad::FULL);
   p_maps = &p_element->GetDofToQuad(*rule, DofToQuad::FULL);
   spaces.Displacement().GetElementVDofs(element, u_dofs);
   spaces.Pressure().GetElementDofs(element, p_dofs);
   u.GetSubVector(u_dofs, u_values);
   p_field.GetSubVector(p_dofs, p_values);
   reference.SetSize(u_element->GetDof(), 3);
   gradients.SetSize(u_element->GetDof(), 3);
   p_reference.SetSize(p_element->GetDof(), 3);
   p_gradients.SetSize(p_element->GetDof(), 3);
   p_shape.SetSize(p_element->GetDof());
}

void BodyElement::SetPoint(int point)
{
   const int points = Points();
   ip = &rule->IntPoint(point);
   trans->SetIntPoint(ip);
   weight = ip->weight * trans->Weight();
   GetReferenceGradients(*u_maps, point, points, reference);
   Mult(reference, trans->InverseJacobian(), gradients);
   GetReferenceGradients(*p_maps, point, points, p_reference);
   Mult(p_reference, trans->InverseJacobian(), p_gradients);
   const int u_size = gradients.Height();
   for (int a = 0; a < 3; a++)
   {
      const real_t *const values = u_values.GetData() + a * u_size;
      for (int b = 0; b < 3; b++)
      {
         const real_t *const gradient = gradients.GetColumn(b);
         real_t sum = a == b ? 1.0 : 0.0;
         for (int i = 0; i < u_size; i++)
         {
            sum += values[i] * gradient[i];
         }
         F[a][b] = sum;
      }
   }
   p = 0.0;
   grad_p = {};
   for (int k = 0; k < p_shape.Size(); k++)
   {
      p_shape[k] = p_maps->B[point + points * k];
      p += p_shape[k] * p_values[k];
      for (int b = 0; b < 3; b++)
      {
         grad_p[b] += p_gradients(k, b) * p_values[k];
      }
   }
}

Vector BodyElement::Position() const
{
   Vector position(3);
   trans->Transform(*ip, position);
   return position;
}

} // namespace synovia
