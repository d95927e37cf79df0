#include "synovia/contact/contact_surface.hpp"
#include "synovia/mesh/boundary_marker.hpp"

namespace synovia
{

using namespace mfem;

DeformedFace::DeformedFace(BiphasicSpaces &spaces,
                           const SurfaceVertices &surface, int boundary_element)
   : geometry(spaces.GetMesh().GetBdrElementGeometry(boundary_element)),
     element(spaces.Displacement().GetBE(boundary_element))
{
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
   spaces.Multiplier().GetBdrElementDofs(boundary_element, vertices);
   for (int &vertex : vertices)
   {
      vertex = surface.Local(vertex);
   }

   IsoparametricTransformation trans;
   spaces.GetMesh().GetBdrElementTransformation(boundary_element, &trans);
   const FiniteElement &position_element =
      trans.GetFE()->GetOrder() > element->GetOrder() ? *trans.GetFE()
                                                      : *element;
   const IntegrationRule &points = position_element.GetNodes();
   DenseMatrix positions(3, points.GetNPoints());
   DenseMatrix interpolation(nodes.Size(), points.GetNPoints());
   for (int i = 0; i < points.GetNPoints(); i++)
   {
      Vector x;
      positions.GetColumnReference(i, x);
      trans.Transform(points.IntPoint(i), x);
      Vector column;
      interpolation.GetColumnReference(i, column);
      element->CalcShape(points.IntPoint(i), column);
   }
   const DenseMatrix powers = FacePolynomial::PowersFromNodes(position_element);
   powers_from_displacement.SetSize(nodes.Size(), powers.Width());
   Mult(interpolation, powers, powers_from_displacement);
   reference = FacePolynomial(position_element);
   Mult(positions, powers, reference.Coefficients());
   current = reference;
}

void DeformedFace::SetDisplacement(const Vector &u)
{
   DenseMatrix nodal(3, u_dofs.Size() / 3);
   for (int i = 0; i < u_dofs.Size(); i++)
   {
      nodal(i % 3, i / 3) = u[u_dofs[i]];
   }
   current = reference;
   AddMult(nodal, powers_from_displacement, current.Coefficients());
}

Box DeformedFace::CurrentBox() const
{
   Box box;
   const IntegrationRule &nodes = element->GetNodes();
   for (int k = 0; k < nodes.GetNPoints(); k++)
   {
      box.Add(Current(nodes.IntPoint(k)).position);
   }
   const IntegrationRule &corners = *Geometries.GetVertices(geometry);
   for (int k = 0; k < corners.GetNPoints(); k++)
   {
      box.Add(Current(corners.IntPoint(k)).position);
   }
   box.Inflate(0.1 * box.LongestEdge());
   return box;
}

ContactSurface::ContactSurface(BiphasicSpaces &spaces_,
                               const Array<int> &boundary_)
   : spaces(spaces_), boundary(boundary_),
     vertices(spaces, BoundaryMarker(spaces.GetMesh(), boundary))
{
   ParMesh &mesh = spaces.GetMesh();
   const Array<int> marker = BoundaryMarker(mesh, boundary);
   for (int i = 0; i < mesh.GetNBE(); i++)
   {
      if (marker[mesh.GetBdrAttribute(i) - 1])
      {
         faces.emplace_back(spaces, vertices, i);
      }
   }
   spaces.Displacement().GetEssentialTrueDofs(marker, u_tdofs);
   spaces.Pressure().GetEssentialTrueDofs(marker, p_tdofs);
}

void ContactSurface::SetDisplacement(const Vector &u)
{
   ParGridFunction field(&spaces.Displacement());
   field.SetFromTrueDofs(u);
   field.HostRead();
   for (DeformedFace &face : faces)
   {
      face.SetDisplacement(field);
   }
}

void ContactSurface::GetVertexShapes(int face, const IntegrationPoint &ip,
                                     Vector &shapes) const
{
   const FiniteElement &vertices_of_face =
      *spaces.Multiplier().FEColl()->FiniteElementForGeometry(
         faces[face].GetGeometry());
   shapes.SetSize(vertices_of_face.GetDof());
   vertices_of_face.CalcShape(ip, shapes);
}

void ContactSurface::Archive(StateArchive &archive, const std::string &name,
                             Vector &values) const
{
   Vector all = vertices.ToTrueDofs(values);
   archive.Field(name, spaces.Multiplier(), all);
   values = vertices.FromTrueDofs(all);
}

} // namespace synovia
