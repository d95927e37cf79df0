#include "synovia/fem/loaded_face.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

LoadedFace::LoadedFace(BiphasicSpaces &spaces_) : spaces(spaces_) {}

void LoadedFace::Set(int boundary_element, const Vector &u)
{
   u_element = spaces.Displacement().GetBE(boundary_element);
   p_element = spaces.Pressure().GetBE(boundary_element);
   spaces.GetMesh().GetBdrElementTransformation(boundary_element, &trans);
   // The area is of second order in positions.
   rule = &IntRules.Get(u_element->GetGeomType(),
                        3 * std::max(u_element->GetOrder(), trans.Order()));
   spaces.Displacement().GetBdrElementVDofs(boundary_element, u_dofs);
   spaces.Pressure().GetBdrElementDofs(boundary_element, p_dofs);
   u.GetSubVector(u_dofs, u_values);
   shape.SetSize(u_element->GetDof());
   p_shape.SetSize(p_element->GetDof());
   slopes.SetSize(u_element->GetDof(), 2);
}

void LoadedFace::SetPoint(int point)
{
   const IntegrationPoint &ip = rule->IntPoint(point);
   trans.SetIntPoint(&ip);
   weight = ip.weight;
   u_element->CalcShape(ip, shape);
   p_element->CalcShape(ip, p_shape);
   u_element->CalcDShape(ip, slopes);
   const DenseMatrix &undeformed = trans.Jacobian();
   const int nodes = shape.Size();
   for (int k = 0; k < 2; k++)
   {
      for (int a = 0; a < 3; a++)
      {
         tangents[k][a] = undeformed(a, k);
         for (int i = 0; i < nodes; i++)
         {
            tangents[k][a] += slopes(i, k) * u_values[a * nodes + i];
         }
      }
   }
   area = Cross(tangents[0], tangents[1]);
}

Point3 LoadedFace::AreaChange(int node) const
{
   Point3 change;
   for (int a = 0; a < 3; a++)
   {
      change[a] =
         slopes(node, 0) * tangents[1][a] - slopes(node, 1) * tangents[0][a];
   }
   return change;
}

} // namespace synovia
