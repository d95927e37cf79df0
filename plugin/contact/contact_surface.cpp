#include "contact/contact_surface.hpp"

namespace synovia
{

using namespace mfem;

DeformedFace::DeformedFace(BiphasicSpaces &spaces, int boundary_element)
   : geometry(spaces.GetMesh().GetBdrElementGeometry(boundary_element)),
     element(spaces.Displacement().GetBE(boundary_element))
{
   spaces.GetMesh().GetBdrElementTransformation(boundary_element, &trans);
   Array<int> nodes;
   spaces.Displacement().GetBdrElementDofs(boundary_element, nodes);
   u_dofs.SetSize(3 * nodes.Size());
   for (int k = 0; k < nodes.Size(); k++)
   {
      for (int d = 0; d < 3; d++)
      {
         u_dofs[3 * k + d] = spaces.Displacement().DofToVDof(nodes[k], d);
      }
   }
   spaces.Pressure().GetBdrElementDofs(boundary_element, p_dofs);
   spaces.Multiplier().GetBdrElementDofs(boundary_element, m_dofs);
   position_element =
      trans.GetFE()->GetOrder() > element->GetOrder() ? trans.GetFE() : element;
   const IntegrationRule &points = position_element->GetNodes();
   reference_nodes.SetSize(3, points.GetNPoints());
   interpolation.SetSize(nodes.Size(), points.GetNPoints());
   for (int i = 0; i < points.GetNPoints(); i++)
   {
      Vector x;
      reference_nodes.GetColumnReference(i, x);
      trans.Transform(points.IntPoint(i), x);
      Vector column;
      interpolation.GetColumnReference(i, column);
      element->CalcShape(points.IntPoint(i), column);
   }
   current_nodes = reference_nodes;
   shape.SetSize(points.GetNPoints());
   dshape.SetSize(points.GetNPoints(), 2);
}

void DeformedFace::SetDisplacement(const Vector &u)
{
   DenseMatrix nodal(3, u_dofs.Size() / 3);
   for (int i = 0; i < u_dofs.Size(); i++)
   {
      nodal(i % 3, i / 3) = u[u_dofs[i]];
   }
   current_nodes = reference_nodes;
   AddMult(nodal, interpolation, current_nodes);
}

Point3 DeformedFace::ReferencePoint(const IntegrationPoint &ip) const
{
   Point3 x;
   Vector position(x.data(), 3);
   trans.Transform(ip, position);
   return x;
}

real_t DeformedFace::ReferenceWeight(const IntegrationPoint &ip) const
{
   trans.SetIntPoint(&ip);
   return trans.Weight();
}

Point3 DeformedFace::CurrentPoint(const IntegrationPoint &ip,
                                  std::array<Point3, 2> *tangents) const
{
   const int nodes = current_nodes.Width();
   position_element->CalcShape(ip, shape);
   Point3 x{{0.0, 0.0, 0.0}};
   for (int k = 0; k < nodes; k++)
   {
      for (int d = 0; d < 3; d++)
      {
         x[d] += shape[k] * current_nodes(d, k);
      }
   }
   if (tangents)
   {
      position_element->CalcDShape(ip, dshape);
      for (int a = 0; a < 2; a++)
      {
         Point3 &tangent = (*tangents)[a];
         tangent = {0.0, 0.0, 0.0};
         for (int k = 0; k < nodes; k++)
         {
            for (int d = 0; d < 3; d++)
            {
               tangent[d] += dshape(k, a) * current_nodes(d, k);
            }
         }
      }
   }
   return x;
}

Point3 DeformedFace::CurrentNormal(const IntegrationPoint &ip) const
{
   std::array<Point3, 2> tangents;
   CurrentPoint(ip, &tangents);
   const Point3 normal = Cross(tangents[0], tangents[1]);
   const real_t length = Length(normal);
   return {normal[0] / length, normal[1] / length, normal[2] / length};
}

Point3 DeformedFace::ReferenceNormal(const IntegrationPoint &ip) const
{
   trans.SetIntPoint(&ip);
   Point3 normal;
   Vector direction(normal.data(), 3);
   CalcOrtho(trans.Jacobian(), direction);
   direction /= direction.Norml2();
   return normal;
}

Box DeformedFace::CurrentBox() const
{
   Box box;
   const IntegrationRule &nodes = element->GetNodes();
   for (int k = 0; k < nodes.GetNPoints(); k++)
   {
      box.Add(CurrentPoint(nodes.IntPoint(k)));
   }
   const IntegrationRule &corners = *Geometries.GetVertices(geometry);
   for (int k = 0; k < corners.GetNPoints(); k++)
   {
      box.Add(CurrentPoint(corners.IntPoint(k)));
   }
   box.Inflate(0.1 * box.LongestEdge());
   return box;
}

ContactSurface::ContactSurface(BiphasicSpaces &spaces_,
                               const Array<int> &boundary)
   : spaces(spaces_)
{
   ParMesh &mesh = spaces.GetMesh();
   Array<int> marker(mesh.bdr_attributes.Max());
   marker = 0;
   for (const int attribute : boundary)
   {
      marker[attribute - 1] = 1;
   }
   for (int i = 0; i < mesh.GetNBE(); i++)
   {
      if (marker[mesh.GetBdrAttribute(i) - 1])
      {
         faces.emplace_back(spaces, i);
      }
   }
   spaces.Displacement().GetEssentialTrueDofs(marker, u_tdofs);
   spaces.Pressure().GetEssentialTrueDofs(marker, p_tdofs);
   spaces.Multiplier().GetEssentialTrueDofs(marker, m_tdofs);
}

void ContactSurface::SetDisplacement(const Vector &u)
{
   ParGridFunction field(&spaces.Displacement());
   field.SetFromTrueDofs(u);
   for (DeformedFace &face : faces)
   {
      face.SetDisplacement(field);
   }
}

} // namespace synovia
